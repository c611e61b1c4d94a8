#include "plant/simulate.hpp"

#include <fmt/format.h>

#include <cmath>

namespace servoid {

namespace {

constexpr long kToldEvery = 1024; // rows

} // namespace

SimulatedRun simulate_run(const Model& model, const Experiment& experiment, unsigned long seed,
                          const Progress& progress) {
    DriveOptions options;
    options.seed = seed, options.torque_noise = experiment.torque_noise;
    SimulatedDrive drive(model, options);
    Capture out;
    out.linear = model.motion == Motion::linear;
    out.sample_time_s = drive.sample_time_s();
    out.period_s = experiment.period_s;
    out.position_quantum = drive.position_per_count();
    out.metadata["source"] =
        fmt::format("servoid simulate, {}, {}, seed {}", model.name, experiment.text, seed);
    out.metadata["sample_time_s"] = fmt::format("{:.17g}", out.sample_time_s);
    if (experiment.period_s)
        out.metadata["period_s"] = fmt::format("{:.17g}", *experiment.period_s);
    if (experiment.start != 0) drive.set_state(experiment.start, 0);
    const double shift = experiment.start - experiment.position_ref(0);
    const long rows = std::lround(experiment.duration_s / out.sample_time_s);
    for (long i = 0; i < rows; ++i) {
        if (progress && i % kToldEvery == 0) progress("simulating", double(i) / double(rows));
        const double t = double(i) * out.sample_time_s;
        const DriveSample s = drive.step(experiment.position_ref(t) + shift);
        out.time_s.push_back(t);
        out.position_ref.push_back(s.reference);
        out.torque_ref.push_back(s.torque);
        out.position.push_back(s.position);
        if (experiment.segment) out.segment.push_back(experiment.segment(t));
    }
    return {std::move(out), drive.saturated()};
}

Capture simulate(const Model& model, const Experiment& experiment, unsigned long seed,
                 const Progress& progress) {
    return simulate_run(model, experiment, seed, progress).capture;
}

} // namespace servoid
