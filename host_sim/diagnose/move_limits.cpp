#include "diagnose/move_limits.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace servoid {

namespace {

constexpr double kAskedSpeed = 1.25, kTopSpeed = 1.4; // of what was recorded
constexpr double kPeakTorque = 1.2;                   // of what was recorded,
constexpr double kRatedTorque = 2.0; // and no more than this where the drive is rated for it
constexpr double kTolerance = 0.02;  // of the travel: overshoot, rounded numbers in the text
constexpr double kLonger = 3;        // times the longest record
constexpr double kLeast_s = 2;       // a move may always last

double largest(const std::vector<double>& values) {
    double out = 0;
    for (double v : values)
        out = std::max(out, std::abs(v));
    return out;
}

// Differences over so many samples that a count is a hundredth of the speed in question.
double top_speed(const Capture& capture, double about) {
    const double step = capture.sample_time_s;
    const auto over = size_t(1 + 100 * capture.position_quantum / (about * step));
    double out = 0;
    for (size_t i = over; i < capture.rows(); ++i)
        out = std::max(out, std::abs(capture.position[i] - capture.position[i - over]));
    return out / (double(over) * step);
}

} // namespace

MoveLimits limits_of(const Model& model, const std::vector<PreparedMotion>& motions) {
    MoveLimits out;
    out.lowest = INFINITY, out.highest = -INFINITY;
    double speed = 0, torque = 0, length_s = 0;
    Drive drive = model.drive;
    for (const PreparedMotion& m : motions) {
        const Capture& c = *m.capture;
        if (c.has_position()) {
            const auto [low, high] = std::minmax_element(c.position.begin(), c.position.end());
            out.lowest = std::min(out.lowest, *low), out.highest = std::max(out.highest, *high);
        }
        speed = std::max(speed, m.motion.top_speed());
        torque = std::max(torque, m.asked.samples.cwiseAbs().maxCoeff());
        length_s = std::max(length_s, double(c.rows()) * c.sample_time_s);
        out.sample_time_s = c.sample_time_s;
        if (c.torque_in_ampere) drive = {}; // the drive's numbers are N·m
        out.position_quantum = std::max(out.position_quantum, c.position_quantum);
    }
    if (model.controller) out.sample_time_s = model.controller->sample_time_s;
    out.asked_speed = kAskedSpeed * speed, out.top_speed = kTopSpeed * speed;
    out.peak_torque =
        std::max(kPeakTorque * torque, std::min(kRatedTorque * torque, drive.rated_torque));
    if (drive.torque_limit > 0) out.peak_torque = std::min(out.peak_torque, drive.torque_limit);
    out.longest_s = std::max(kLeast_s, kLonger * length_s);
    return out;
}

Use use_of(const Capture& capture, const MoveLimits& limits) {
    const auto [low, high] = std::minmax_element(capture.position.begin(), capture.position.end());
    const double room = kTolerance * limits.travel();
    const double middle = (limits.lowest + limits.highest) / 2;
    Use out;
    out.travel = std::max(*high - middle, middle - *low) / (limits.travel() / 2 + room);
    out.speed = top_speed(capture, limits.top_speed) / limits.top_speed;
    out.torque = largest(capture.torque_ref) / limits.peak_torque;
    return out;
}

} // namespace servoid
