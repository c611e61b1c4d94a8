#include "diagnose/candidates.hpp"

#include "common/error.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>

namespace servoid {

namespace {

constexpr int kMostRounds = 4;
constexpr size_t kMostPolished = 6;
constexpr double kChanges = 0.9;      // error after over before
constexpr double kLittleTorque = 0.7; // of what was asked arrives; the error is a share of that
constexpr double kAnyVariation = 0.1; // of the torque about its mean arrives at least
constexpr double kHardlyAny = 0.03;   // of the inertia before
constexpr double kAnyway = 0.5;       // error after over before: it explains what arrives
constexpr double kGivesWay = 0.9;     // held-out error after over before
constexpr double kWorthPolishing = 2; // times the least held-out error

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

double variation(const Eigen::VectorXd& torque) {
    return (torque.array() - torque.mean()).matrix().norm();
}

// The error is a share of the torque that arrives: a law that lets little through explains little.
// Only a limit may cut most of it, where it explains what arrives, and where something does.
bool far_less_torque(const Candidate& c, const FitResult& before) {
    if (variation(c.fit.torque) < kAnyVariation * variation(before.torque)) return true;
    const bool explains =
        c.effect == "torque_saturation" && c.error_after < kAnyway * before.torque_error;
    return !explains && c.fit.torque.norm() < kLittleTorque * before.torque.norm();
}

// Far below its antiresonance a load shows one number, how far it gives way, and neither frequency.
bool only_gives_way(const Candidate& c, const FitResult& before, Assembler& assembler) {
    if (c.effect != "elastic_load") return false;
    const EffectTerm& load = c.fit.model.effects.back();
    return load.at("resonance_frequency") > load.at("antiresonance_frequency") &&
           c.validation_error_after < kGivesWay * held_out_error(before, assembler);
}

// What keeps a fitted candidate from being an answer, or "".
std::string fault_of(const Candidate& c, const Effect& effect, const FitResult& before,
                     const Assembler& assembler) {
    std::string out;
    for (const FittedParameter& p : c.parameters) {
        if (p.at_bound)
            out = p.name + " is on its bound";
        else if (must_be_known(p) && !(2 * p.estimate.std < std::abs(p.estimate.value)))
            out = p.name + " is not determined";
    }
    std::string why; // one capture that it suits is enough
    for (const MotionView& view : assembler.views())
        if (why = effect.implausible(c.fit.model.effects.back(), view); why.empty()) break;
    if (!why.empty()) out = why;
    if (why = out_of_bounds(c.fit.model); !why.empty()) out = why;
    if (far_less_torque(c, before)) out = "far less torque than moved the axis";
    if (c.fit.model.inertia < kHardlyAny * before.model.inertia) out = "it leaves no inertia";
    if (is_harmonic(c, assembler.motions()))
        out = "a harmonic of the repeated move: another period shows it";
    if (c.error_after >= before.torque_error) out = "it does not help";
    return out;
}

// Fills in what a fit says of its last effect.
void describe(Candidate& c, const Effect& effect, const FitResult& before, Assembler& assembler) {
    c.error_after = c.fit.torque_error;
    HeldOut unseen = held_out(c.fit, assembler);
    c.blocks_after = std::move(unseen.blocks);
    c.foreseen_error_after = std::max(unseen.foreseen, c.error_after);
    // A descent that stopped at a bend may predict better than it fits, by its tangents: no merit.
    const double predicted = error_of(c.blocks_after);
    if (predicted < c.error_after)
        for (double& power : c.blocks_after)
            power *= std::pow(c.error_after / predicted, 2);
    c.validation_error_after = std::max(predicted, c.error_after);
    const std::string prefix = effect.info().name;
    c.parameters.clear();
    for (const FittedParameter& p : c.fit.parameters) {
        const size_t dot = p.name.find('.');
        const std::string term = p.name.substr(0, dot);
        if (term != prefix && !term.starts_with(prefix + "#")) continue;
        c.parameters.push_back(p);
        c.parameters.back().name = p.name.substr(dot + 1);
    }
    const size_t own = effect.parameters(c.fit.model.effects.back())
                           .size(); // the last of several of the same name
    c.parameters.erase(c.parameters.begin(), c.parameters.end() - long(own));
    c.note = fault_of(c, effect, before, assembler);
    c.sound = c.note.empty();
    if (!c.sound && c.error_after < before.torque_error && only_gives_way(c, before, assembler)) {
        c.sound = true;
        c.note = "how far it gives way shows, its frequencies do not: move up to them";
    }
    if (!c.fit.converged && c.note.empty()) c.note = "the fit met its bound on iterations";
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
        describe(c, effect, before, assembler);
    } catch (const Refusal& refusal) {
        c.note = refusal.what();
    }
    return c;
}

// work(i, assembler, reports) for i < count, by two threads: each has its own assembler, and takes
// the next when it has done one.
template <class Work>
void share_out(size_t count, const std::vector<PreparedMotion>& motions, const Work& work) {
    std::atomic<size_t> next = 0;
    const auto worker = [&](bool reports) {
        Assembler assembler(motions);
        for (size_t i = next++; i < count; i = next++)
            work(i, assembler, reports);
    };
    std::future<void> other = std::async(std::launch::async, worker, false);
    try {
        worker(true);
    } catch (...) { // stopped by who looks at the progress: the other one has no more to do
        next = count;
        throw;
    }
    other.get();
}

} // namespace

std::vector<Candidate> try_all(const FitResult& before, const std::vector<PreparedMotion>& motions,
                               const Progress& progress, Tried tried) {
    std::vector<const Effect*> effects;
    for (const Effect* effect : catalogue()) {
        if (effect->info().written || !cannot_add(*effect, before.model).empty()) continue;
        const bool solved = effect->shape_keys(EffectTerm{}).empty();
        if (tried == Tried::all || (tried == Tried::solved) == solved) effects.push_back(effect);
    }
    std::vector<Candidate> out(effects.size());
    share_out(effects.size(), motions, [&](size_t i, Assembler& assembler, bool reports) {
        if (reports && progress)
            progress(effects[i]->info().name, double(i) / double(effects.size()));
        out[i] = try_effect(before, *effects[i], assembler);
    });
    return out;
}

void polish_best(std::vector<Candidate>& candidates, const FitResult& before,
                 const std::vector<PreparedMotion>& motions) {
    std::vector<Candidate*> best;
    for (Candidate& c : candidates) // one that changes little has the artifact of the model before
        if (c.sound && c.error_after < kChanges * before.torque_error) best.push_back(&c);
    std::sort(best.begin(), best.end(), [](const Candidate* a, const Candidate* b) {
        return a->validation_error_after < b->validation_error_after;
    });
    while (!best.empty() && (best.size() > kMostPolished ||
                             best.back()->validation_error_after >
                                 kWorthPolishing * best.front()->validation_error_after))
        best.pop_back();
    share_out(best.size(), motions, [&](size_t i, Assembler& assembler, bool) {
        best[i]->fit = without_artifact(best[i]->fit, assembler, 1);
        describe(*best[i], *find_effect(best[i]->effect), before, assembler);
    });
}

void finish(Candidate& candidate, const FitResult& before, Assembler& assembler) {
    candidate.fit = without_artifact(candidate.fit, assembler, kMostRounds);
    describe(candidate, *find_effect(candidate.effect), before, assembler);
}

} // namespace servoid
