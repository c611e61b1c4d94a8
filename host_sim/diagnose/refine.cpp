#include "compare/homing_search.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/evidence.hpp"
#include "effects/catalogue.hpp"

#include "common/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace servoid {

namespace {

constexpr int kMostRungs = 8;
constexpr double kWorthAdding = 0.03; // of the held-out power of the residual
constexpr double kClearly = 0.08;     // the same, for an effect that the evidence alone leaves open
constexpr double kLost = 0.01;        // an effect whose removal costs less is needless

// On captures that were never fitted, each at its own position zero, or on blocks that were not
// where there are none.
double validation_error(const FitResult& fit, Assembler& assembler,
                        const std::vector<PreparedMotion>& validation) {
    return validation.empty() ? held_out_error(fit, assembler)
                              : torque_error_of(fit.model, validation, 0);
}

// The candidate that a greedy step takes: the most probable one that is worth its parameters; its
// simple form first where that does most of it.
const Candidate* next_step(const Diagnosis& d) {
    double none = 1;
    for (const Candidate& c : d.candidates)
        none -= c.probability;
    const Candidate* best = nullptr;
    for (const Candidate& c : d.candidates) {
        const double worth = c.probability > none ? kWorthAdding : kClearly;
        if (!best && c.sound && gain_of(d, c) >= worth) best = &c;
    }
    if (!best) return nullptr;
    // A law of no catalogue explains more than the best of it.
    if (d.verdict == Verdict::unknown && !d.outside.empty()) return nullptr;
    for (const Candidate& c : d.candidates)
        if (c.sound && is_richer_form(best->effect, c.effect) &&
            gain_of(d, c) > 0.8 * gain_of(d, *best))
            return &c;
    return best;
}

// An effect whose foundation (Coulomb friction under Stribeck's) is not in the model.
bool leaves_orphan(const Model& model) {
    for (const EffectTerm& term : model.effects)
        for (const std::string& needed : find_effect(term.name)->info().needs)
            if (!model.find(needed) && !model.find(needed + "_asymmetric")) return true;
    return false;
}

// Effects (other than those the user gave) whose removal costs nothing on held-out data.
void prune(Refinement& r, Assembler& assembler, size_t given) {
    for (size_t i = r.result.model.effects.size(); i-- > given;) {
        Model smaller = r.result.model;
        const std::string name = smaller.effects[i].name;
        smaller.effects.erase(smaller.effects.begin() + long(i));
        if (leaves_orphan(smaller)) continue;
        try {
            assembler.set_homing(r.result.homing);
            const FitResult without = fit(smaller, assembler);
            const double before = held_out_error(r.result, assembler);
            const double after = held_out_error(without, assembler);
            if (after * after > (1 + kLost) * before * before) continue;
            r.result = without;
            r.removed.push_back(name);
        } catch (const Refusal&) {
        }
    }
}

// The next rung of the ladder, told to whoever listens.
void climb(Refinement& r, Rung rung, const DiagnoseOptions& options) {
    r.ladder.push_back(std::move(rung));
    r.noise_floor = r.last.noise_floor;
    if (options.on_rung) options.on_rung(r);
}

} // namespace

Refinement refine(const Model& model, const std::vector<PreparedMotion>& motions,
                  const std::vector<PreparedMotion>& validation, const DiagnoseOptions& options) {
    Refinement r;
    Assembler assembler(motions);
    DiagnoseOptions step_options = options;
    step_options.look_ahead = false;
    r.last = diagnose(model, motions, step_options);
    r.result = r.last.before;
    climb(r, {"", r.result.torque_error, validation_error(r.result, assembler, validation)},
          options);
    for (int rung = 0; rung < kMostRungs; ++rung) {
        if (r.last.verdict == Verdict::adequate || r.last.verdict == Verdict::insufficient) break;
        const Candidate* step = next_step(r.last);
        if (!step) break;
        const std::string added = step->effect;
        const FitResult taken = step->fit;
        const double validated = validation_error(taken, assembler, validation);
        if (!validation.empty() && validated > 0.999 * r.ladder.back().validation_error) break;
        r.result = taken;
        climb(r, {added, taken.torque_error, validated}, options);
        r.last = diagnose(r.result.model, motions, step_options);
    }
    prune(r, assembler, model.effects.size());
    r.last = diagnose(r.result.model, motions, options);
    r.verdict = r.last.verdict;
    r.noise_floor = r.last.noise_floor;
    r.validation_homing = homing_against(r.result.model, validation, 0);
    return r;
}

} // namespace servoid
