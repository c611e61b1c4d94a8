// A simulated capture: a model's drive given an experiment.
#pragma once

#include "capture/capture.hpp"
#include "common/progress.hpp"
#include "plant/drive.hpp"
#include "plant/experiment.hpp"

namespace servoid {

struct SimulatedRun {
    Capture capture;
    bool saturated = false; // the loop met its torque limit
};

SimulatedRun simulate_run(const Model& model, const Experiment& experiment, unsigned long seed,
                          const Progress& progress = {});
Capture simulate(const Model& model, const Experiment& experiment, unsigned long seed,
                 const Progress& progress = {});

} // namespace servoid
