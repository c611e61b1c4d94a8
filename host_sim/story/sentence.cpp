#include "story/sentence.hpp"

#include "answers/json.hpp"
#include "effects/catalogue.hpp"
#include "effects/custom_argument.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid {

namespace {

std::string in_words(const std::string& effect) {
    return is_custom(effect) ? effect : find_effect(effect)->info().title;
}

std::string floor_of(double floor) { return "the noise floor is " + percent(floor); }

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

std::string of_diagnosis(const Diagnosis& d) {
    const std::string error = percent(d.error_before);
    switch (d.verdict) {
    case Verdict::missing: {
        const Candidate& best = d.candidates.front();
        return fmt::format("The model lacks {}: with it the torque error falls from {} to {}; {}.",
                           in_words(best.effect), error, percent(best.error_after),
                           floor_of(d.noise_floor));
    }
    case Verdict::ambiguous:
        return fmt::format(
            "The model leaves {} of the torque. This is explained equally well by {}: "
            "another move tells them apart.",
            error, rivals(d));
    case Verdict::unknown:
        return fmt::format("The model leaves {} of the torque, more than noise ({}), and no effect "
                           "of the catalogue explains it.",
                           error, percent(d.noise_floor));
    case Verdict::adequate:
        return fmt::format("The model explains this capture: what is left, {} of the torque, is "
                           "noise ({}).",
                           error, percent(d.noise_floor));
    case Verdict::insufficient:
        break;
    }
    return "This capture cannot answer" + (d.shortage ? ": " + d.shortage->why : "") + ".";
}

// What the refined model has beyond the first one.
std::string of_refinement(const Refinement& r, const Model& given) {
    std::string added;
    for (const EffectTerm& term : r.result.model.effects)
        if (!given.find(term.name)) added += (added.empty() ? "" : ", ") + in_words(term.name);
    return fmt::format(" With {} together it comes down to {}.", added,
                       percent(r.result.torque_error));
}

} // namespace

std::string sentence(const Comparison& comparison, const Diagnosis* diagnosis,
                     const Refinement* refinement) {
    if (!diagnosis)
        return fmt::format("Model and measurement are {} of the torque apart; {}.",
                           percent(comparison.torque_error), floor_of(comparison.floor.ratio));
    std::string out = of_diagnosis(*diagnosis);
    if (refinement && refinement->ladder.size() > 2)
        out += of_refinement(*refinement, diagnosis->before.model);
    return out;
}

} // namespace servoid
