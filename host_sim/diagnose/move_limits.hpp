// How far a proposed move may go: what the axis has been seen to survive, and little more.
#pragma once

#include "compare/motion.hpp"
#include "model/model.hpp"

#include <algorithm>

namespace servoid {

struct MoveLimits {
    double lowest = 0, highest = 0; // position, rad or m: the ends of the recorded travel
    double asked_speed = 0;         // rad/s or m/s: what a reference asks for at most
    double top_speed = 0;           // the same, with the loop's overshoot
    double peak_torque = 0;         // N·m or N
    double sample_time_s = 0;       // of the loop
    double position_quantum = 0;    // of the encoder
    double longest_s = 0;           // of a move
    double travel() const { return highest - lowest; }
};

// Position stays within what was recorded: nothing is known of what lies beyond. Speed: asked for
// 1.25 times the recorded one, 1.4 times with overshoot, which doubles the energy that a brake or a
// stop has to take and no more. Torque: 1.2 times the recorded peak; where the model states a rated
// torque, which the drive bears for ever, up to that, but no more than twice the recorded peak;
// never above the drive's limit.
MoveLimits limits_of(const Model& model, const std::vector<PreparedMotion>& motions);

// The most that a capture makes use of any limit; above 1 it breaks one.
struct Use {
    double speed = 0, torque = 0, travel = 0; // of what is allowed
    double most() const { return std::max({speed, torque, travel}); }
};
Use use_of(const Capture& capture, const MoveLimits& limits);

} // namespace servoid
