// Friction from runs at constant speed: eqs. (8)–(14), by the firmware core.
#pragma once

#include "capture/capture.hpp"
#include "compare/motion.hpp"
#include "effects/effect.hpp"

#include <string>
#include <vector>

namespace servoid {

// One stretch of constant speed.
struct SpeedRun {
    std::string file;
    int segment = -1;                // of the capture, −1: the whole of it
    double velocity = 0, torque = 0; // means
    double residual = 0;             // torque less what the friction law says
    double torque_spread = 0;        // standard deviation of the samples in the run
    long samples = 0;
};

// One direction, eqs. (10)–(12).
struct DirectionFit {
    Estimate viscous, offset; // offset: Tc + w forward, Tc − w reverse
    int runs = 0;
};

struct FrictionResult {
    Estimate viscous, coulomb, constant_torque; // eqs. (13), (14)
    DirectionFit forward, reverse;
    std::vector<SpeedRun> runs;
};

// Constant-speed stretches of a capture: each segment, else the longest stretches within 3 % (or
// two quanta) of their own median speed. Starts and stops are left out.
std::vector<SpeedRun> find_runs(const Capture& capture, Input input);

// Throws Refusal with fewer than two speeds in a direction, or one direction only.
FrictionResult fit_friction(std::vector<SpeedRun> runs);

} // namespace servoid
