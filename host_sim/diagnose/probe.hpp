// What a residual depends on, without naming a law: a free function of one variable.
#pragma once

#include "compare/regression.hpp"

#include <string>
#include <vector>

namespace servoid {

struct Probe {
    std::string name;     // "position", "velocity", "time", "acceleration × time", ...
    double explained = 0; // share of the residual's power, on blocks it was not fitted to
    double z = 0;         // that share over its standard error from block to block
};

// Each probe is a piecewise linear function of a variable with equally filled bins, times a factor;
// fitted to the residual beyond what the model's own free columns could explain.
std::vector<Probe> probe_residual(const FitResult& fit, Assembler& assembler);

} // namespace servoid
