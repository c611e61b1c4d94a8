#include "diagnose/weigh.hpp"

#include "diagnose/coherence.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kBeyondNoise = 0.6;  // a gain that fed-back noise has not been seen to make
constexpr double kFollows = 0.4;      // of a linear dynamics' gain must follow the reference
constexpr double kAsked = 0.02;       // probability from which a gain is compared with noise's
constexpr double kPerBound = 4;       // price, as a logarithm
constexpr double kBeyondDoubt = 0.35; // error after over before: no noise does that

// Laws are fitted to a motion that was measured and smoothed: two that come this near each other
// are told apart by more than the number of samples.
constexpr double kMostCount = 150;

// −BIC/2 with the number of independent residuals instead of samples, and a price for the search.
double log_evidence(const FitResult& fit, double error, double count, double price) {
    return -count * std::log(error) - 0.5 * fit.free_parameters * std::log(count) - price;
}

// Asymmetric Coulomb friction is Coulomb friction and a constant torque: where both explain the
// residual about as well, the simpler name wins.
void prefer_simple_names(const Diagnosis& d, std::vector<double>& evidence) {
    size_t rich = d.candidates.size(), simple = rich;
    for (size_t i = 0; i < d.candidates.size(); ++i) {
        if (d.candidates[i].effect == "coulomb_asymmetric") rich = i;
        if (d.candidates[i].effect == "constant_torque" && d.candidates[i].sound) simple = i;
    }
    if (rich == d.candidates.size() || simple == d.candidates.size()) return;
    const double a = d.candidates[simple].validation_error_after;
    if (a < 1.1 * d.candidates[rich].validation_error_after)
        evidence[rich] = std::min(evidence[rich], evidence[simple] - 4);
}

// Linear dynamics between asked torque and motion: what noise in a closed loop imitates.
bool is_linear_dynamics(const std::string& effect) {
    return effect == "dead_time" || effect == "torque_lag" || effect == "elastic_load";
}

// Noise of a loop does not repeat: what is removed beyond it is no noise.
bool repeats(const Diagnosis& d, const Candidate& c) {
    const double removed = d.error_before * d.error_before - c.error_after * c.error_after;
    return d.floor_from_repetition && removed > d.noise_floor * d.noise_floor;
}

// Rejects dynamics whose gain does not follow the reference, or for which nothing tells.
void reject_loop_noise(Diagnosis& d, Assembler& assembler) {
    const auto doubtful = [&](const Candidate& c) {
        if (!c.sound || !is_linear_dynamics(c.effect) || repeats(d, c)) return false;
        return 1 - std::pow(c.error_after / d.error_before, 2) <= kBeyondNoise;
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

void set_probabilities(Diagnosis& d) {
    const Candidate* best = nullptr;
    for (const Candidate& c : d.candidates)
        if (c.sound && (!best || c.error_after < best->error_after)) best = &c;
    if (!best) return;
    const double count = std::min(kMostCount, effective_count(best->fit.residual));
    const double floor = 0.3 * d.noise_floor; // an error below the noise is luck, not evidence
    double none = log_evidence(d.before, std::max(floor, d.error_before), count, 0);
    double top = none;
    std::vector<double> value;
    for (const Candidate& c : d.candidates) {
        double v = -INFINITY;
        if (c.sound)
            v = log_evidence(c.fit, std::max(floor, c.validation_error_after), count,
                             find_effect(c.effect)->search_price() +
                                 kPerBound * newly_bound(d.before, c.fit)) -
                (c.noise_gain > 0 ? count * c.noise_gain : 0);
        value.push_back(v);
    }
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
    set_probabilities(d);
    while (Candidate* c = doubtful(d)) {
        const auto gain = gain_from_noise(d.before, *find_effect(c->effect), assembler);
        if (!gain) {
            reject_loop_noise(d, assembler);
            set_probabilities(d);
            return;
        }
        c->noise_gain = *gain;
        set_probabilities(d);
    }
}

} // namespace servoid
