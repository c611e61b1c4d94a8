// The draw of an experiment that can show an effect.
#pragma once

#include "blind/plans.hpp"

namespace blind {

struct Drawn {
    Move move;
    bool scaled = true;      // false: the move is in rad or m already
    double most_travel = 0;  // rad or m
    double torque_share = 0; // of rated, wanted rms
};

Drawn draw_move(Excites what, const System& system, Random& random);

// Amplitude of the move that meets its wishes on this axis, and the motion it makes there.
double choose_amplitude(const Drawn& drawn, const System& system, const World& world);
Motion motion_of(const Record& record, const Move& move, double step_s);

} // namespace blind
