// Parameters as the JSON and the terminal show them.
#pragma once

#include "cli/app.hpp"
#include "compare/regression.hpp"

namespace servoid::cli {

// {"value": …, "std": …, "unit": …}; a number that is not finite becomes null.
Json parameter(double value, double std, const std::string& unit);
Json number(double value);

// All parameters of a fit by name ("inertia", "viscous.coefficient").
Json fitted_parameters(const FitResult& fit, bool ampere);

// One line per parameter: name, value ± std, unit.
void print_parameters(const Output& out, const FitResult& fit, bool ampere);

// Position zeros that differ from the first capture's (or, of captures that were not fitted, from
// the model's).
struct CaptureZero {
    std::string file;
    Estimate offset;
    std::string unit;
};
std::vector<CaptureZero> zeros_of(const Homing& homing, const std::vector<Capture>& captures);
// Only where there are any: "homing" in the JSON, a line each on the terminal.
void add_homing(Json& out, const std::vector<CaptureZero>& zeros);
void print_homing(const Output& out, const std::vector<CaptureZero>& zeros);

// The model as JSON, the tables of the model file.
Json model_json(const Model& model);

std::string percent(double ratio); // three significant digits and a percent sign

} // namespace servoid::cli
