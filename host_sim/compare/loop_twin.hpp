// The capture that a model would have made: its own loop, given the recorded reference.
#pragma once

#include "capture/capture.hpp"
#include "model/model.hpp"

#include <optional>

namespace servoid {

struct TwinNoise {
    double torque = 0; // N·m or N per sample, white, disturbs the axis
    unsigned long seed = 1;
};

// Starts from the recorded first position, velocity and torque; where the record already runs in a
// periodic motion, one period before it. Torque and position are counted as they were recorded.
// Where only every n-th control period was recorded, the others are simulated too.
// Nothing without a controller, a reference, a position, or where a row is no whole number of
// control periods. Cost: about 1 µs a row, a few times that with effects that are not linear.
std::optional<Capture> loop_twin(const Model& model, const Capture& capture,
                                 const TwinNoise& noise = {});

} // namespace servoid
