#include "diagnose/weigh.hpp"

#include "diagnose/coherence.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/structure.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kBeyondNoise = 0.6;       // a gain that fed-back noise has not been seen to make
constexpr double kBeyondNoiseUntold = 0.8; // where no reference was recorded
constexpr double kFollows = 0.4;           // of a linear dynamics' gain must follow the reference
constexpr double kAsked = 0.02;            // probability from which a gain is compared with noise's
constexpr double kMuchTheSame = 1.1;       // in error
constexpr double kSameAsRich = 1.3;        // of the same but for instants near rest
constexpr double kPerBound = 4;            // price, as a logarithm
constexpr double kHardlyForeseen = 1.25;   // held out over fitted: a block tells what no other does
constexpr double kBeyondDoubt = 0.35;      // error after over before: no noise does that

// −BIC/2 with the number of independent residuals instead of samples, and a price for the search.
// Errors are told apart down to `least`, and none is smaller for noise that a lag or a limit took.
double log_evidence(const FitResult& fit, double error, double count, double least) {
    return -count * std::log(std::hypot(error / fit.noise_passed, least)) -
           0.5 * fit.free_parameters * std::log(count);
}

// Asymmetric Coulomb friction is Coulomb friction and a constant torque, and a stiff bristle is
// Coulomb friction: where one of them alone explains the residual about as well, the simpler name
// wins.
bool is_simpler(const std::string& simple, const std::string& rich) {
    if (simple == "coulomb") return rich == "coulomb_asymmetric" || rich == "presliding";
    return simple == "constant_torque" && rich == "coulomb_asymmetric";
}

void prefer_simple_names(const Diagnosis& d, std::vector<double>& evidence) {
    for (size_t rich = 0; rich < d.candidates.size(); ++rich) {
        const std::string& rich_name = d.candidates[rich].effect;
        for (size_t simple = 0; simple < d.candidates.size(); ++simple) {
            const Candidate& c = d.candidates[simple];
            if (!c.sound || !is_simpler(c.effect, rich_name)) continue;
            const double most = rich_name == "coulomb_asymmetric" ? kSameAsRich : kMuchTheSame;
            if (c.validation_error_after < most * d.candidates[rich].validation_error_after)
                evidence[rich] = std::min(evidence[rich], evidence[simple] - 4);
        }
    }
}

// What every axis has and this model has not, all together: each of them is as good a first step as
// they are together. A bristle that bends far would else pass for viscous and Coulomb friction.
void credit_everyday(const Diagnosis& d, double least, double count,
                     std::vector<double>& evidence) {
    if (!d.everyday) return;
    double best = -INFINITY;
    for (size_t i = 0; i < evidence.size(); ++i)
        if (is_everyday(d.candidates[i].effect)) best = std::max(best, evidence[i]);
    const double together = log_evidence(d.everyday->fit, d.everyday->error, count, least);
    if (!std::isfinite(best) || !(together > best)) return;
    for (size_t i = 0; i < evidence.size(); ++i)
        if (is_everyday(d.candidates[i].effect)) evidence[i] += together - best;
}

// Linear dynamics between asked torque and motion: what noise in a closed loop imitates.
bool is_linear_dynamics(const std::string& effect) {
    return effect == "dead_time" || effect == "torque_lag" || effect == "elastic_load";
}

// A lag and a dead time that leave much the same are told apart by how often, block after block,
// one leaves less: no further than that returns (Vuong, Econometrica 57, 1989).
void tell_apart_by_blocks(const Diagnosis& d, double least, double count,
                          std::vector<double>& evidence) {
    const size_t top =
        size_t(std::max_element(evidence.begin(), evidence.end()) - evidence.begin());
    if (!is_linear_dynamics(d.candidates[top].effect)) return;
    const auto size = [&](size_t i) {
        return std::hypot(d.candidates[i].validation_error_after, least);
    };
    for (size_t i = 0; i < evidence.size(); ++i) {
        if (i == top || !std::isfinite(evidence[i]) || size(i) > kMuchTheSame * size(top)) continue;
        if (!is_linear_dynamics(d.candidates[i].effect)) continue;
        const double apart = count * std::log(size(i) / size(top));
        const double z =
            std::max(0.0, gain_z(d.candidates[i].blocks_after, d.candidates[top].blocks_after));
        evidence[i] += std::max(0.0, apart - z * z / 2);
    }
}

// Noise of a loop does not repeat: what is removed beyond it is no noise.
bool repeats(const Diagnosis& d, const Candidate& c) {
    const double removed = d.error_before * d.error_before - c.error_after * c.error_after;
    return d.floor_from_repetition && removed > d.noise_floor * d.noise_floor;
}

bool has_reference(const std::vector<PreparedMotion>& motions) {
    return std::none_of(motions.begin(), motions.end(), [](const PreparedMotion& m) {
        return m.capture->position_ref.empty() || !m.capture->uniform;
    });
}

// Rejects dynamics whose gain does not follow the reference, or for which nothing tells.
void reject_loop_noise(Diagnosis& d, Assembler& assembler) {
    const bool told = has_reference(assembler.motions());
    const auto doubtful = [&](const Candidate& c) {
        if (!c.sound || !is_linear_dynamics(c.effect) || repeats(d, c)) return false;
        const double gain = 1 - std::pow(c.error_after / d.error_before, 2);
        return gain <= (told ? kBeyondNoise : kBeyondNoiseUntold);
    };
    if (std::none_of(d.candidates.begin(), d.candidates.end(), doubtful)) return;
    const std::optional<double> share =
        coherent_share(d.before.residual, assembler.motions(), assembler.blocks());
    for (Candidate& c : d.candidates) {
        const double gain = 1 - std::pow(c.error_after / d.error_before, 2);
        if (!doubtful(c) || (share && *share >= kFollows * gain)) continue;
        c.sound = false;
        c.note = share ? "noise that the loop feeds round: it does not follow the reference"
                       : "as well noise that the loop feeds round: record the reference";
    }
}

// Parameters that the candidate drives onto their bound: a friction that would come out negative is
// a sign that something else is missing.
double newly_bound(const FitResult& before, const FitResult& after) {
    const double more = double(after.at_bound.size()) - double(before.at_bound.size());
    return std::max(0.0, more);
}

// By how many of its standard deviations the effect is there at all: its first parameter is its
// size.
double size_z(const Candidate& c) {
    if (c.parameters.empty()) return 0;
    const Estimate& size = c.parameters.front().estimate;
    return size.std > 0 ? std::abs(size.value) / size.std : 0;
}

// How many independent residuals the evidence counts. The spectrum of the best residual gives few
// where something else is still in it; a gain that comes back block after block counts for more.
double independent_count(const Diagnosis& d, const Candidate& best) {
    const double fall = std::log(d.validation_error_before / best.validation_error_after);
    const double z = std::max(gain_z(d.blocks_before, best.blocks_after), size_z(best));
    const double from_blocks = fall > 0 && z > 0 ? z * z / 2 / fall : 0;
    return std::min(kMostCount, std::max(effective_count(best.fit.residual), from_blocks));
}

// What the effect knows of the values it was found with.
double known_beforehand(const Candidate& c, const std::vector<MotionView>& views) {
    Estimates estimates;
    for (const FittedParameter& p : c.parameters)
        estimates[p.name] = p.estimate;
    const Effect& effect = *find_effect(c.effect);
    const double first = effect.evidence(estimates, views.front());
    const bool agree = std::all_of(views.begin(), views.end(), [&](const MotionView& view) {
        return effect.evidence(estimates, view) == first;
    });
    return agree ? first : 0; // one capture alone may tell what another cannot
}

// What a candidate leaves of data it was not fitted to. Where even the best one predicts some block
// badly, that block alone tells a parameter (a single start the inertia), and which rival it suits
// by chance is no evidence: then its error is held against what could be foreseen of it.
double unseen_error(const Candidate& c, const Candidate& best) {
    const bool foreseen = best.validation_error_after < kHardlyForeseen * best.error_after;
    return foreseen ? c.validation_error_after : c.foreseen_error_after;
}

void set_probabilities(Diagnosis& d, const std::vector<MotionView>& views) {
    const Candidate* best = nullptr;
    for (const Candidate& c : d.candidates)
        if (c.sound && (!best || c.error_after < best->error_after)) best = &c;
    if (!best) return;
    const double count = independent_count(d, *best);
    const double floor = 0.3 * d.noise_floor; // an error below the noise is luck, not evidence
    // Half of what is slight, and what the method may itself leave of each: no more than it did
    // leave.
    const double doubt = std::max(d.before.doubt, best->fit.doubt);
    const double least = std::hypot(kSlight / 2, std::min(doubt, best->error_after));
    const double none = log_evidence(d.before, std::max(floor, d.error_before), count, least);
    double top = none;
    std::vector<double> value;
    for (const Candidate& c : d.candidates) {
        double v = -INFINITY;
        if (c.sound)
            v = log_evidence(c.fit, std::max(floor, unseen_error(c, *best)), count, least) -
                find_effect(c.effect)->search_price() - kPerBound * newly_bound(d.before, c.fit) -
                (c.noise_gain > 0 ? count * c.noise_gain : 0) + known_beforehand(c, views);
        value.push_back(v);
    }
    tell_apart_by_blocks(d, least, count, value);
    credit_everyday(d, least, count, value);
    prefer_simple_names(d, value);
    for (double v : value)
        top = std::max(top, v);
    double all = std::exp(none - top);
    for (double v : value)
        all += std::exp(v - top);
    for (size_t i = 0; i < value.size(); ++i)
        d.candidates[i].probability = std::exp(value[i] - top) / all;
    std::stable_sort(d.candidates.begin(), d.candidates.end(),
                     [](const Candidate& a, const Candidate& b) {
                         if (a.probability != b.probability) return a.probability > b.probability;
                         return a.validation_error_after < b.validation_error_after;
                     });
}

// The most probable candidate whose gain noise might make, and that has not been asked yet.
Candidate* doubtful(Diagnosis& d) {
    for (Candidate& c : d.candidates) {
        const bool moderate = c.validation_error_after > kBeyondDoubt * d.validation_error_before;
        if (c.sound && moderate && c.probability > kAsked && std::isnan(c.noise_gain)) return &c;
    }
    return nullptr;
}

} // namespace

void weigh(Diagnosis& d, Assembler& assembler) {
    set_probabilities(d, assembler.views());
    while (Candidate* c = doubtful(d)) {
        const auto gain = gain_from_noise(d.before, *find_effect(c->effect), assembler);
        if (!gain) {
            reject_loop_noise(d, assembler);
            set_probabilities(d, assembler.views());
            return;
        }
        c->noise_gain = *gain;
        set_probabilities(d, assembler.views());
    }
}

} // namespace servoid
