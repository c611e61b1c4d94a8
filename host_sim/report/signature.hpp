// What an effect looks like where it is missing: made by the simulated drive and the torque view.
#pragma once

#include "effects/effect.hpp"

#include <string>
#include <vector>

namespace servoid {

struct Signature {
    std::vector<double> x, y; // the residual torque against what shows it best
    std::string x_name, x_unit, y_name, y_unit;
    double smallest_range = 0; // of y: below it there is nothing to see
};

// A small motor with the effect and the friction beside it (EffectInfo::picture) makes the move;
// what a model leaves of the torque that is right but for the effect is the signature. Its numbers
// stay: fitted again, they would take up a part of what looks alike.
Signature signature_of(const Effect& effect);

// The motor, with the effect and without.
Model motor_with(const Effect& effect);
Model motor_without(const Effect& effect);

} // namespace servoid
