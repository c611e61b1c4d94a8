// Whether a residual still depends on something, named or not.
#pragma once

#include "diagnose/probe.hpp"

#include <optional>
#include <vector>

namespace servoid {

// Less of the torque than this, in rms, is below what a simulation, a filter and a sample's width
// agree on: nothing is claimed of it.
inline constexpr double kSlight = 0.002;

struct Structure {
    std::vector<Probe> probes;    // best first
    std::optional<Probe> evident; // the best, where it is beyond chance, noise and kSlight
};

// error: of the fit, on blocks it was not fitted to. The free functions of probe.hpp, against the
// same on twins of the fitted model in which nothing is missing (twin.hpp).
Structure structure_of(const FitResult& fit, double error, Assembler& assembler);

} // namespace servoid
