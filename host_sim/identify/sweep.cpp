#include "identify/sweep.hpp"

#include "identify/identify.hpp"

#include <cmath>
#include <numbers>

namespace servoid {

namespace {

Model with_encoder(Model model, double bits) {
    if (bits > 0) model.sensor.position_per_count = 2 * std::numbers::pi / std::exp2(bits);
    return model;
}

// The session's own samples as a capture, so that the same code looks at them as at a recording.
void record(Capture& capture, const DriveSample& s) {
    capture.time_s.push_back(double(capture.rows()) * capture.sample_time_s);
    capture.position.push_back(s.position);
    capture.torque_ref.push_back(s.torque);
    capture.position_ref.push_back(s.reference);
}

SweepPoint point_at(const Model& model, double frequency_Hz, const SweepOptions& options) {
    DriveOptions drive_options;
    drive_options.seed = options.seed + static_cast<unsigned long>(frequency_Hz * 1000);
    drive_options.torque_noise = options.torque_noise;
    SimulatedDrive drive(model, drive_options);
    Capture capture;
    capture.path = "sweep";
    capture.sample_time_s = drive.sample_time_s();
    capture.position_quantum = drive.position_per_count();
    capture.linear = model.motion == Motion::linear;
    capture.period_s = 1 / frequency_Hz;
    SweepPoint out;
    out.answer = run_session(drive, {{frequency_Hz, options.amplitude}}, options.session,
                             [&](const DriveSample& s) { record(capture, s); })
                     .front();
    out.error_percent = (out.answer.inertia / model.inertia - 1) * 100;
    if (out.answer.reason != SID_OK) return out;
    IdentifyOptions identify_options;
    identify_options.frequencies_Hz = {frequency_Hz};
    identify_options.first_period = options.session.ramp_periods + options.session.settle_periods;
    identify_options.last_period = *identify_options.first_period + options.session.window_periods;
    identify_options.method = options.session.method;
    identify_options.model = &model;
    const Identification again = identify(capture, identify_options).front();
    out.inertia_clean = out.answer.inertia - again.coulomb_leak;
    out.inertia_std = again.inertia.std;
    return out;
}

} // namespace

Sweep sweep(const Model& model_given, const SweepOptions& options) {
    const Model model = with_encoder(model_given, options.encoder_bits);
    Sweep out;
    std::vector<double> f, j, std;
    for (double at = options.from_Hz; at <= options.to_Hz * (1 + 1e-9); at += options.step_Hz) {
        out.points.push_back(point_at(model, at, options));
        if (out.points.back().answer.reason != SID_OK) continue;
        f.push_back(at), j.push_back(out.points.back().inertia_clean);
        std.push_back(out.points.back().inertia_std);
    }
    out.corrected = remove_elastic_bias(f, j, std);
    return out;
}

} // namespace servoid
