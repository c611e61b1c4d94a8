#include "diagnose/rival_record.hpp"

#include "common/error.hpp"
#include "compare/assembly.hpp"
#include "effects/catalogue.hpp"
#include "plant/simulate.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kCounter = 1 << 22; // counts that the drive's reference can hold, with room

// Encoder and full torque as they were recorded where the model does not say.
Model driven(Model model, const MoveLimits& limits) {
    double& per_count = model.sensor.position_per_count;
    if (!(per_count > 0)) per_count = limits.position_quantum;
    const double reach = std::max(std::abs(limits.lowest), std::abs(limits.highest));
    per_count = std::max(per_count, reach / kCounter);
    if (!(model.drive.rated_torque > 0) && !(model.drive.torque_limit > 0))
        model.drive.rated_torque = limits.peak_torque / 4; // the core holds eight times that
    return model;
}

// The motion that follows the reference without error.
MotionView along(const Experiment& experiment, const Model& model, double step_s) {
    const auto rows = Eigen::Index(experiment.duration_s / step_s);
    MotionView view;
    view.sample_time_s = step_s, view.kind = model.motion;
    view.band_Hz = 0.1 / step_s;
    view.time_s = Vector::LinSpaced(rows, 0, double(rows - 1) * step_s);
    // As if it had always moved like this: a start from rest would be a blow.
    const auto at = [&](Eigen::Index i) { return experiment.position_ref(double(i) * step_s); };
    view.position.resize(rows), view.velocity.resize(rows), view.acceleration.resize(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double before = at(i - 1), here = at(i), after = at(i + 1);
        view.position[i] = here;
        view.velocity[i] = (after - before) / (2 * step_s);
        view.acceleration[i] = (after - 2 * here + before) / (step_s * step_s);
    }
    return view;
}

// Asked torque that arrives as the needed one, a pure delay apart: asked for again and again with
// what was missing. What no lag lets through fast enough (the jump of Coulomb friction) stays
// missing far above the band; what a limit holds back is no record of this move.
TorqueSignal asked_for(const Model& model, const Vector& needed, double step_s) {
    constexpr int passes = 40;
    constexpr double most_missing = 0.05;
    TorqueSignal asked{needed, step_s, false, 0};
    Vector missing = Vector::Zero(needed.size());
    for (int pass = 0; pass < passes; ++pass) {
        asked.samples += missing;
        const TorqueSignal arrives = delivered_by(model, {asked.samples, step_s, false, 0});
        missing = needed - arrives.samples;
        asked.delay_s = -arrives.delay_s;
        if (missing.norm() < 1e-6 * needed.norm()) break;
    }
    if (missing.norm() > most_missing * needed.norm())
        throw Refusal("the model cannot deliver the torque of this move", "a gentler move");
    return asked;
}

Capture along_the_reference(const Model& model, const Experiment& experiment,
                            const MoveLimits& limits) {
    const double step = limits.sample_time_s;
    const MotionView motion = in_context(model, along(experiment, model, step));
    const TorqueSignal asked = asked_for(model, motion.torque, step);
    Capture out;
    out.linear = model.motion == Motion::linear;
    out.sample_time_s = step;
    out.period_s = experiment.period_s;
    out.ref_held = false;
    out.torque_delay_s = asked.delay_s;
    out.position_quantum = limits.position_quantum;
    out.time_s.assign(motion.time_s.begin(), motion.time_s.end());
    out.torque_ref.assign(asked.samples.begin(), asked.samples.end());
    out.position.assign(motion.position.begin(), motion.position.end());
    out.position_ref = out.position;
    if (out.position_quantum > 0)
        for (double& p : out.position)
            p = std::round(p / out.position_quantum) * out.position_quantum;
    return out;
}

} // namespace

Capture record_of(const Model& model, const Experiment& experiment, const MoveLimits& limits) {
    Capture out = model.controller ? simulate(driven(model, limits), experiment, 1)
                                   : along_the_reference(model, experiment, limits);
    out.path = experiment.text;
    return out;
}

} // namespace servoid
