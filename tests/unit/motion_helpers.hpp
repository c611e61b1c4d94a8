// Captures made from a motion and a torque law, sample by sample: no simulator, no loop.
#pragma once

#include "compare/motion.hpp"

#include <cmath>
#include <functional>
#include <numbers>

namespace servoid {

struct Kinematics {
    double position = 0, velocity = 0, acceleration = 0;
};

// A sum of two sines: reversals, several speeds, known derivatives. 2 s period.
inline Kinematics two_sines(double t) {
    constexpr double w = std::numbers::pi, a = 2.0, b = 0.8, m = 3;
    return {a * std::sin(w * t) + b * std::sin(m * w * t),
            a * w * std::cos(w * t) + b * m * w * std::cos(m * w * t),
            -a * w * w * std::sin(w * t) - b * m * m * w * w * std::sin(m * w * t)};
}

using TorqueLaw = std::function<double(const Kinematics&, double)>;

// Torque and position sampled at the same instants.
inline Capture sampled(const TorqueLaw& torque, double duration_s, double step_s = 1e-3) {
    Capture c;
    c.path = "made";
    c.sample_time_s = step_s;
    c.ref_held = false;
    const auto rows = std::size_t(std::lround(duration_s / step_s));
    for (std::size_t i = 0; i < rows; ++i) {
        const double t = double(i) * step_s;
        const Kinematics k = two_sines(t);
        c.time_s.push_back(t), c.position.push_back(k.position);
        c.torque_ref.push_back(torque(k, t));
    }
    return c;
}

} // namespace servoid
