#include "diagnose/diagnose.hpp"

#include "common/error.hpp"
#include "compare/homing_search.hpp"
#include "diagnose/advice.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/outside.hpp"
#include "diagnose/structure.hpp"
#include "diagnose/twin.hpp"
#include "diagnose/weigh.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kSure = 0.9;       // probability from which one candidate stands alone
constexpr double kLeastGain = 0.03; // of the residual's power: less is not worth a name
constexpr double kNearFloor = 1.15; // times the floor: the residual is noise
constexpr double kColoured = 0.02;  // of the torque: an error that is not white is no noise
constexpr double kPeaked = 6;       // fourth moment: noise has 3, what comes in bursts far more
constexpr double kLarge = 0.1;      // of the torque: so much in bursts is no noise
constexpr double kWhite = 0.15;     // of the points are independent; half of them where it is white
constexpr double kWorthFinishing = 0.3; // probability
constexpr double kSameTwice = 0.8;      // of the smaller gain of two is common to both
constexpr double kAsGood = 0.7; // of what a free function explains: then a named law is as good

double family_probability(const Diagnosis& d) {
    double sum = d.candidates.front().probability;
    for (size_t i = 1; i < d.candidates.size(); ++i)
        if (is_richer_form(d.candidates[i].effect, d.candidates.front().effect))
            sum += d.candidates[i].probability;
    return sum;
}

std::optional<Everyday> everyday_of(const FitResult& before, Assembler& assembler) {
    Model model = before.model;
    for (const char* name : {"viscous", "coulomb", "constant_torque"}) {
        const Effect& effect = *find_effect(name);
        if (!cannot_add(effect, before.model).empty()) continue;
        EffectTerm term;
        term.name = name, term.parameters[effect.info().parameters[0].key] = 0;
        model.effects.push_back(term);
    }
    if (model.effects.size() < before.model.effects.size() + 2) return std::nullopt;
    assembler.set_artifact(before.artifact);
    try {
        Everyday out{fit(model, assembler, going_on_from(before)), 0};
        out.error = std::max(out.fit.torque_error, held_out_error(out.fit, assembler));
        return out;
    } catch (const Refusal&) { // one way only: the same thing twice
        return std::nullopt;
    }
}

// Two effects that not every axis has, each of which alone explains what the other does: more
// likely one law that lies between them than both at once.
bool same_twice(const Diagnosis& d, const Candidate& first, const Candidate& second) {
    if (is_everyday(first.effect) || is_everyday(second.effect)) return false;
    for (const Candidate& alone : d.candidates) {
        if (alone.effect != second.effect || !alone.sound || &alone == &first) continue;
        const double one = gain_of(d, first), other = gain_of(d, alone);
        return one + other - gain_of(d, second) > kSameTwice * std::min(one, other);
    }
    return false;
}

// Something is left that a free function of one variable explains and the catalogue does not.
bool unexplained(Diagnosis& d, const Candidate& best, Assembler& assembler) {
    if (best.validation_error_after < d.noise_floor) return false;
    const Structure left = structure_of(best.fit, best.validation_error_after, assembler);
    d.probes = left.probes;
    if (!left.evident) return false;
    for (const Tried tried : {Tried::solved, Tried::searched})
        for (const Candidate& second : try_all(best.fit, assembler.motions(), {}, tried)) {
            if (!second.sound || same_twice(d, best, second)) continue;
            const double ratio = second.validation_error_after / best.validation_error_after;
            if (1 - ratio * ratio > kAsGood * left.evident->explained) return false;
        }
    return true;
}

// No candidate is worth a name: noise, or something that none of them is.
Verdict without_candidate(Diagnosis& d, Assembler& assembler) {
    Structure left = structure_of(d.before, d.validation_error_before, assembler);
    const double own = 2 * std::hypot(kSlight, d.before.doubt); // of the method
    const bool repeats =
        d.floor_from_repetition && d.error_before > std::hypot(1.5 * d.noise_floor, own);
    d.probes = std::move(left.probes);
    const bool coloured =
        d.error_before > std::max({3 * d.noise_floor, kColoured, own}) &&
        effective_count(d.before.residual) < kWhite * double(d.before.residual.size());
    const bool bursts = d.error_before > std::max({3 * d.noise_floor, kLarge, own}) &&
                        peakedness(d.before.residual) > kPeaked;
    if (left.evident) return Verdict::unknown;
    d.not_noise = repeats    ? "repeats with the move"
                  : bursts   ? "comes in bursts"
                  : coloured ? "is alike from one instant to the next"
                             : "";
    return d.not_noise.empty() ? Verdict::adequate : Verdict::unknown;
}

Verdict judge(Diagnosis& d, Assembler& assembler, bool look_ahead) {
    const bool any = !d.candidates.empty() && d.candidates.front().sound;
    const double gain = any ? gain_of(d, d.candidates.front()) : 0;
    const bool near_floor = d.error_before < kNearFloor * d.noise_floor;
    double none = 1;
    for (const Candidate& c : d.candidates)
        none -= c.probability;
    const bool slight = std::sqrt(std::max(0.0, gain)) * d.validation_error_before < kSlight;
    const bool luck = near_floor && gain < 0.25;
    if (!any || luck || gain < kLeastGain || slight || none > 0.5)
        return without_candidate(d, assembler);
    const auto rival = outside_rival(d, d.candidates.front(), assembler);
    const bool better = rival && rival->z > kBetter;
    if (!better && look_ahead && unexplained(d, d.candidates.front(), assembler))
        return Verdict::unknown;
    if (rival) {
        d.outside = rival->law;
        return better ? Verdict::unknown : Verdict::ambiguous;
    }
    return family_probability(d) >= kSure ? Verdict::missing : Verdict::ambiguous;
}

} // namespace

bool is_everyday(const std::string& effect) {
    return effect.starts_with("viscous") || effect.starts_with("coulomb") ||
           effect == "constant_torque";
}

bool is_richer_form(const std::string& rich, const std::string& simple) {
    return rich == simple + "_asymmetric" || (rich == "presliding" && simple == "coulomb");
}

double gain_of(const Diagnosis& d, const Candidate& c) {
    return 1 - std::pow(c.validation_error_after / d.validation_error_before, 2);
}

const char* verdict_name(Verdict verdict) {
    switch (verdict) {
    case Verdict::missing:
        return "missing";
    case Verdict::ambiguous:
        return "ambiguous";
    case Verdict::unknown:
        return "unknown";
    case Verdict::adequate:
        return "adequate";
    case Verdict::insufficient:
        break;
    }
    return "insufficient";
}

Diagnosis diagnose(const Model& model, const std::vector<PreparedMotion>& motions,
                   const DiagnoseOptions& options) {
    Assembler assembler(motions);
    Diagnosis d;
    d.before = without_artifact(fit_homed(model, assembler), assembler, 2);
    d.error_before = d.before.torque_error;
    d.blocks_before = held_out_blocks(d.before, assembler);
    d.validation_error_before = error_of(d.blocks_before);
    const NoiseFloor floor = noise_floor_of_all(d.before.model, motions, d.before.homing);
    d.noise_floor = floor.ratio, d.floor_from_repetition = floor.from_repetition;
    for (const PreparedMotion& m : motions)
        d.band_Hz = std::max(d.band_Hz, m.band_Hz);
    d.candidates = try_all(d.before, motions, options.progress);
    if (options.progress) options.progress("weighing the best of them", 1);
    d.everyday = everyday_of(d.before, assembler);
    polish_best(d.candidates, d.before, motions);
    weigh(d, assembler);
    if (d.candidates.front().sound && d.candidates.front().probability > kWorthFinishing) {
        finish(d.candidates.front(), d.before, assembler);
        weigh(d, assembler);
    }
    share_aliases(d, motions);
    d.verdict = judge(d, assembler, options.look_ahead);
    d.shortage = shortage_of(d, assembler);
    if (d.shortage) d.verdict = Verdict::insufficient;
    d.cannot_show = unseen_of(d, assembler);
    if (options.look_ahead) d.next = next_of(d, motions); // not in the steps of refine
    d.advice = advice_for(d);
    return d;
}

} // namespace servoid
