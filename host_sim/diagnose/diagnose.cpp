#include "diagnose/diagnose.hpp"

#include "common/error.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/advice.hpp"
#include "diagnose/coherence.hpp"
#include "diagnose/evidence.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>

namespace servoid {

namespace {

constexpr double kBeyondNoise = 0.6;   // a gain that fed-back noise has not been seen to make
constexpr double kFollows = 0.4;       // of a linear dynamics' gain must follow the reference
constexpr double kSure = 0.9;          // probability from which one candidate stands alone
constexpr double kLeastGain = 0.03;    // of the residual's power: less is not worth a name
constexpr double kNearFloor = 1.15;    // times the floor: the residual is noise
constexpr double kProbeExplains = 0.6; // of what is left: something depends on that variable
constexpr double kMaterial = 0.09; // of the power removed: less than that left is no second cause

// Laws are fitted to a motion that was measured and smoothed: two that come this near each other
// are told apart by more than the number of samples.
constexpr double kMostCount = 150;

// A gain of the torque is taken up by inertia and friction together: never a finding unless one of
// them is held.
bool is_alias(const Effect& effect, const Model& model) {
    if (effect.info().name != "torque_gain") return false;
    if (model.inertia_fixed) return false;
    return std::none_of(model.effects.begin(), model.effects.end(),
                        [](const EffectTerm& t) { return !t.fixed.empty(); });
}

// A sine of time at a harmonic of a repeated move cannot be told from what the move itself causes.
bool is_harmonic(const Candidate& c, const std::vector<PreparedMotion>& motions) {
    if (c.effect != "periodic_disturbance") return false;
    for (const PreparedMotion& m : motions) {
        if (!m.period_s) return false;
        const double cycles = c.fit.model.effects.back().at("frequency") * *m.period_s;
        const double periods = double(m.grid.count) * m.grid.step_s / *m.period_s;
        if (std::abs(cycles - std::round(cycles)) > 0.25 / periods) return false;
    }
    return true;
}

// Angles and damping ratios may be as uncertain as they like; all else has to be there.
bool must_be_known(const FittedParameter& p) {
    return p.quantity != Quantity::angle && !p.name.ends_with("damping") &&
           !p.name.ends_with("rest_position") && !p.fixed;
}

void describe(Candidate& c, const Effect& effect, const FitResult& before,
              const Assembler& assembler) {
    const std::string prefix = effect.info().name;
    for (const FittedParameter& p : c.fit.parameters) {
        const size_t dot = p.name.find('.');
        const std::string term = p.name.substr(0, dot);
        if (term != prefix && !term.starts_with(prefix + "#")) continue;
        c.parameters.push_back(p);
        c.parameters.back().name = p.name.substr(dot + 1);
    }
    const size_t own = effect.info().parameters.size(); // the last of several of the same name
    c.parameters.erase(c.parameters.begin(), c.parameters.end() - long(own));
    for (const FittedParameter& p : c.parameters) {
        if (p.at_bound)
            c.note = p.name + " is on its bound";
        else if (must_be_known(p) && !(2 * p.estimate.std < std::abs(p.estimate.value)))
            c.note = p.name + " is not determined";
    }
    if (const std::string why =
            effect.implausible(c.fit.model.effects.back(), assembler.views().front());
        !why.empty())
        c.note = why;
    if (c.fit.torque.norm() < 0.7 * before.torque.norm())
        c.note = "far less torque than moved the axis";
    if (is_harmonic(c, assembler.motions()))
        c.note = "a harmonic of the repeated move: another period shows it";
    if (c.error_after >= before.torque_error) c.note = "it does not help";
    c.sound = c.note.empty();
    if (!c.fit.converged && c.sound) c.note = "the fit met its bound on iterations";
}

Candidate try_effect(const FitResult& before, const Effect& effect, Assembler& assembler) {
    Candidate c;
    c.effect = effect.info().name;
    c.signature = effect.info().signature;
    if (is_alias(effect, before.model)) {
        c.note = "the same as other inertia and friction: fix one of them to see it";
        return c;
    }
    try {
        c.fit = fit_with(before, effect, assembler);
        c.fitted = true;
        c.error_after = c.fit.torque_error;
        c.validation_error_after = held_out_error(c.fit, assembler);
        describe(c, effect, before, assembler);
    } catch (const Refusal& refusal) {
        c.note = refusal.what();
    }
    return c;
}

// Every effect that may stand in the model, by two threads: each has its own assembler, and takes
// the next effect when it has done one.
std::vector<Candidate> try_all(const FitResult& before, const std::vector<PreparedMotion>& motions,
                               const DiagnoseOptions& options) {
    std::vector<const Effect*> effects;
    for (const Effect* effect : catalogue())
        if (!effect->info().written && cannot_add(*effect, before.model).empty())
            effects.push_back(effect);
    std::vector<Candidate> out(effects.size());
    std::atomic<size_t> next = 0;
    const auto work = [&](bool reports) {
        Assembler assembler(motions);
        for (size_t i = next++; i < effects.size(); i = next++) {
            if (reports && options.progress)
                options.progress(effects[i]->info().name, double(i) / double(effects.size()));
            out[i] = try_effect(before, *effects[i], assembler);
        }
    };
    std::future<void> other = std::async(std::launch::async, work, false);
    work(true);
    other.get();
    return out;
}

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

// Rejects dynamics whose gain does not follow the reference.
void reject_loop_noise(Diagnosis& d, Assembler& assembler) {
    const auto gains = [&](const Candidate& c) {
        return c.sound && is_linear_dynamics(c.effect) && c.error_after < d.error_before;
    };
    if (std::none_of(d.candidates.begin(), d.candidates.end(), gains)) return;
    const std::optional<double> share =
        coherent_share(d.before.residual, assembler.motions(), assembler.blocks());
    if (!share) return;
    for (Candidate& c : d.candidates) {
        const double gain = 1 - std::pow(c.error_after / d.error_before, 2);
        if (!gains(c) || gain > kBeyondNoise || *share >= kFollows * gain) continue;
        c.sound = false;
        c.note = "noise that the loop feeds round: it does not follow the reference";
    }
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
                             find_effect(c.effect)->search_price());
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

double family_probability(const Diagnosis& d) {
    double sum = d.candidates.front().probability;
    for (size_t i = 1; i < d.candidates.size(); ++i)
        if (is_richer_form(d.candidates[i].effect, d.candidates.front().effect))
            sum += d.candidates[i].probability;
    return sum;
}

// Something is left that a free function of one variable explains and the catalogue does not.
bool unexplained(const Diagnosis& d, const Candidate& best, Assembler& assembler,
                 std::vector<Probe>& probes) {
    const double after = best.validation_error_after, before = d.validation_error_before;
    if (after < 2 * d.noise_floor) return false;
    const double removed = before * before - after * after;
    if (after * after < kMaterial * removed) return false;
    probes = probe_residual(best.fit, assembler);
    if (probes.empty() || probes[0].explained < kProbeExplains || probes[0].z < 3) return false;
    for (const Candidate& second : try_all(best.fit, assembler.motions(), {})) {
        if (!second.sound) continue;
        const double gain = 1 - std::pow(second.validation_error_after / after, 2);
        if (gain > 0.8 * probes[0].explained) return false;
    }
    return true;
}

Verdict judge(Diagnosis& d, Assembler& assembler, bool look_ahead) {
    const bool any = !d.candidates.empty() && d.candidates.front().sound;
    const double gain = any ? gain_of(d, d.candidates.front()) : 0;
    const bool near_floor = d.error_before < kNearFloor * d.noise_floor;
    double none = 1;
    for (const Candidate& c : d.candidates)
        none -= c.probability;
    if (near_floor && gain < 0.25) return Verdict::adequate;
    if (!any || gain < kLeastGain || none > 0.5) {
        d.probes = probe_residual(d.before, assembler);
        const bool structured =
            !d.probes.empty() && d.probes[0].explained > kProbeExplains && d.probes[0].z > 3;
        const bool repeats = d.floor_from_repetition && d.error_before > 1.5 * d.noise_floor;
        return structured || repeats ? Verdict::unknown : Verdict::adequate;
    }
    if (look_ahead && unexplained(d, d.candidates.front(), assembler, d.probes))
        return Verdict::unknown;
    return family_probability(d) >= kSure ? Verdict::missing : Verdict::ambiguous;
}

} // namespace

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
    d.before = fit(model, assembler);
    d.error_before = d.before.torque_error;
    d.validation_error_before = held_out_error(d.before, assembler);
    const NoiseFloor floor = noise_floor_of_all(d.before.model, motions);
    d.noise_floor = floor.ratio, d.floor_from_repetition = floor.from_repetition;
    for (const PreparedMotion& m : motions)
        d.band_Hz = std::max(d.band_Hz, m.band_Hz);
    d.candidates = try_all(d.before, motions, options);
    reject_loop_noise(d, assembler);
    set_probabilities(d);
    d.verdict = judge(d, assembler, options.look_ahead);
    d.advice = advice_for(d);
    return d;
}

} // namespace servoid
