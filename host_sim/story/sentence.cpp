#include "story/sentence.hpp"

#include "answers/json.hpp"
#include "effects/catalogue.hpp"
#include "effects/custom_argument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace servoid {

namespace {

std::string in_words(const std::string& effect) {
    return is_custom(effect) ? effect : find_effect(effect)->info().title;
}

std::string noise_of(double floor) {
    return floor > 0 && floor < 1e-5 ? "less than 0.001 %" : percent(floor);
}

std::string floor_of(double floor) { return "the noise floor is " + noise_of(floor); }

std::string rivals(const Diagnosis& d) {
    std::string out;
    int named = 0;
    for (const Candidate& c : d.candidates) {
        if (named == 3 || c.probability < 0.05) break;
        out += (named++ ? " or " : "") + in_words(c.effect);
    }
    if (!d.outside.empty()) out += " or a law of no catalogue, " + d.outside;
    return out;
}

// "a, two times b and c".
std::string listed(const std::vector<std::string>& names) {
    std::vector<std::string> once;
    for (const std::string& name : names)
        if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
    std::string out;
    for (size_t i = 0; i < once.size(); ++i) {
        const auto times = std::count(names.begin(), names.end(), once[i]);
        out += (i == 0                ? ""
                : i + 1 < once.size() ? ", "
                                      : " and ") +
               (times > 1 ? fmt::format("{} times ", times) : "") + once[i];
    }
    return out;
}

// floor: that of the last model that was looked at, as the page shows it.
std::string of_diagnosis(const Diagnosis& d, double floor) {
    const std::string error = percent(d.error_before);
    switch (d.verdict) {
    case Verdict::missing: {
        const Candidate& best = d.candidates.front();
        return fmt::format("The model lacks {}: with it the torque error falls from {} to {}; {}.",
                           in_words(best.effect), error, percent(best.error_after),
                           floor_of(floor));
    }
    case Verdict::ambiguous:
        return fmt::format(
            "The model leaves {} of the torque. This is explained equally well by {}: "
            "another move tells them apart.",
            error, rivals(d));
    case Verdict::unknown:
        return fmt::format("The model leaves {} of the torque, more than noise ({}): {}.", error,
                           noise_of(floor), d.advice);
    case Verdict::adequate:
        return fmt::format("The model explains this capture: what is left, {} of the torque, is "
                           "noise ({}).",
                           error, noise_of(floor));
    case Verdict::insufficient:
        break;
    }
    return "This capture cannot answer" + (d.shortage ? ": " + d.shortage->why : "") + ".";
}

// What the refined model has beyond the first one.
std::string of_refinement(const Refinement& r, const Model& given) {
    std::vector<std::string> added;
    for (const EffectTerm& term : r.result.model.effects)
        if (!given.find(term.name)) added.push_back(in_words(term.name));
    if (added.empty()) return ""; // it is the refined one that is shown
    return fmt::format(" With {} together it comes down to {}.", listed(added),
                       percent(r.result.torque_error));
}

} // namespace

std::string sentence(const Comparison& comparison, const Diagnosis* diagnosis,
                     const Refinement* refinement) {
    if (!diagnosis)
        return fmt::format("Model and measurement are {} of the torque apart; {}.",
                           percent(comparison.torque_error), floor_of(comparison.floor.ratio));
    std::string out =
        of_diagnosis(*diagnosis, refinement ? refinement->noise_floor : diagnosis->noise_floor);
    if (refinement && refinement->ladder.size() > 2)
        out += of_refinement(*refinement, diagnosis->before.model);
    return out;
}

} // namespace servoid
