// Parameters as the terminal shows them.
#pragma once

#include "answers/fit_json.hpp"
#include "cli/app.hpp"

namespace servoid::cli {

// One line per parameter: name, value ± std, unit.
void print_parameters(const Output& out, const FitResult& fit, bool ampere);

// A line per capture that was not homed.
void print_homing(const Output& out, const Zeros& zeros);

} // namespace servoid::cli
