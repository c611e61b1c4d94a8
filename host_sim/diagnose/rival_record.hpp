// What a model would give on a move: the record that a rival predicts.
#pragma once

#include "diagnose/move_limits.hpp"
#include "plant/experiment.hpp"

namespace servoid {

// In the model's own loop where it has a controller, without noise but with the encoder's counts;
// else the torque that the model needs along the reference itself. Throws Refusal where it needs a
// torque that it cannot deliver.
Capture record_of(const Model& model, const Experiment& experiment, const MoveLimits& limits);

} // namespace servoid
