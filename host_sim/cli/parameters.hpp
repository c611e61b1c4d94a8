// Parameters as the terminal shows them.
#pragma once

#include "answers/fit_json.hpp"
#include "cli/app.hpp"

namespace servoid::cli {

// One line: name, value ± std, unit; two on a narrow terminal.
void print_parameter(const Output& out, const FittedParameter& parameter, const std::string& unit);
// Of all parameters, and those that are held at a bound.
void print_parameters(const Output& out, const FitResult& fit, bool ampere);

// A line per capture that was not homed.
void print_homing(const Output& out, const Zeros& zeros);

} // namespace servoid::cli
