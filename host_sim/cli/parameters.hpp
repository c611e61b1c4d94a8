// Parameters as the terminal shows them.
#pragma once

#include "answers/fit_json.hpp"
#include "cli/app.hpp"

namespace servoid::cli {

// A line for each: name, value ± std, unit; two lines on a narrow terminal.
void print_parameters(const Output& out, const std::vector<FittedParameter>& parameters,
                      Motion motion, bool ampere);
// The same of a fit, and which of them are held at a bound.
void print_parameters(const Output& out, const FitResult& fit, bool ampere);

// A line per capture that was not homed.
void print_homing(const Output& out, const Zeros& zeros);

} // namespace servoid::cli
