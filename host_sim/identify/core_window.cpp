#include "identify/core_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace servoid {

namespace {

constexpr double kTorqueUnits = 1 << 20;
constexpr double kRoom = 1 << 22; // of the core's ±2^23

int32_t rounded(double value) {
    const double limit = std::numeric_limits<int32_t>::max();
    return int32_t(std::lround(std::clamp(value, -limit, limit)));
}

} // namespace

CoreScale choose_scale(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                       double rated_torque, double position_quantum, double sample_time_s) {
    const double top = torque.cwiseAbs().maxCoeff();
    const double travel = position.maxCoeff() - position.minCoeff();
    CoreScale scale{rated_torque, position_quantum, sample_time_s};
    if (!(rated_torque > 0) || top > 7.9 * rated_torque) scale.full_torque = top / 4;
    if (!(scale.full_torque > 0)) scale.full_torque = 1;
    if (!(position_quantum > 0) || travel > kRoom * position_quantum)
        scale.position_per_count = travel > 0 ? travel / kRoom : 1;
    return scale;
}

WindowResult run_window(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                        const WindowTask& task) {
    WindowResult out;
    const CoreScale& s = task.scale;
    // Hertz to 2^-40 Hz in integers, as firmware would hold it.
    const auto scaled = [](double hertz) { return uint64_t(std::llround(std::ldexp(hertz, 40))); };
    const uint64_t increment =
        sid_phase_increment(scaled(task.frequency_Hz), scaled(1 / s.sample_time_s));
    const double origin = position[task.first];
    if (!sid_bin_start(&out.bin, increment, 0, uint32_t(task.count))) {
        out.reason = SID_WINDOW_TOO_SHORT;
        return out;
    }
    for (Eigen::Index i = task.first; i < task.first + task.count; ++i)
        sid_bin_step(&out.bin, rounded(torque[i] / s.full_torque * kTorqueUnits),
                     rounded((position[i] - origin) / s.position_per_count));
    while (!sid_bin_gram_advance(&out.bin, 1U << 16)) {
    }
    sid_inertia_config_t config{};
    config.method = task.method;
    config.torque_timing = task.timing;
    config.torque_min_pu_q20 = 16;
    sid_result_t result{};
    out.reason = sid_inertia_solve(&out.bin, &config, &result);
    const double h = s.sample_time_s, per_count = s.full_torque / s.position_per_count;
    out.inertia = to_double(result.inertia) * per_count * h * h;
    out.viscous = to_double(result.viscous) * per_count * h;
    out.position_amplitude = to_double(result.position_amplitude) * s.position_per_count;
    out.torque_amplitude = to_double(result.torque_amplitude) * s.full_torque;
    return out;
}

WindowResult project(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                     const WindowTask& task) {
    WindowResult out = run_window(torque, position, task);
    if (out.reason != SID_NEGATIVE_INERTIA) return out;
    out = run_window(-torque, position, task);
    out.inertia = -out.inertia, out.viscous = -out.viscous;
    return out;
}

} // namespace servoid
