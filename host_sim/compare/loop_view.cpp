#include "compare/loop_view.hpp"

#include "plant/drive.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

// Straight line through the first positions: the velocity the record starts with.
double first_velocity(const Capture& capture) {
    const size_t n = std::min<size_t>(8, capture.rows());
    double st = 0, sp = 0, stt = 0, stp = 0;
    for (size_t i = 0; i < n; ++i) {
        const double t = double(i) * capture.sample_time_s, p = capture.position[i];
        st += t, sp += p, stt += t * t, stp += t * p;
    }
    const double m = double(n);
    return (stp - st * sp / m) / (stt - st * st / m);
}

bool can_simulate(const Model& model, const Capture& capture) {
    if (!model.controller || capture.position_ref.empty() || !capture.has_position()) return false;
    if (!capture.uniform || capture.torque_in_ampere) return false;
    const double ratio = model.controller->sample_time_s / capture.sample_time_s;
    return std::abs(ratio - 1) <= 0.01;
}

} // namespace

std::optional<LoopError> loop_view(const Model& model, const Capture& capture) {
    if (!can_simulate(model, capture)) return std::nullopt;
    const std::vector<double>& torque =
        capture.torque_ref.empty() ? capture.torque : capture.torque_ref;
    DriveOptions options;
    for (double t : torque)
        options.full_torque = std::max(options.full_torque, std::abs(t) / 4);
    SimulatedDrive drive(model, options);
    drive.set_state(capture.position.front(), first_velocity(capture));
    double torque_power = 0, torque_miss = 0, position_power = 0, position_miss = 0;
    for (size_t i = 0; i < capture.rows(); ++i) {
        const DriveSample s = drive.step(capture.position_ref[i]);
        const double dt = torque[i] - s.torque, dp = capture.position[i] - s.position;
        torque_power += torque[i] * torque[i], torque_miss += dt * dt;
        position_power += capture.position[i] * capture.position[i], position_miss += dp * dp;
    }
    if (!(torque_power > 0) || !(position_power > 0)) return std::nullopt;
    return LoopError{std::sqrt(torque_miss / torque_power),
                     std::sqrt(position_miss / position_power)};
}

} // namespace servoid
