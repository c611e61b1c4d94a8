// A simulated capture: a model's drive given an experiment.
#pragma once

#include "capture/capture.hpp"
#include "plant/drive.hpp"
#include "plant/experiment.hpp"

namespace servoid {

Capture simulate(const Model& model, const Experiment& experiment, unsigned long seed);

} // namespace servoid
