// What a fit found, as JSON: its parameters, and the position zeros of its captures.
#pragma once

#include "answers/json.hpp"
#include "capture/capture.hpp"
#include "compare/regression.hpp"

#include <string>
#include <vector>

namespace servoid {

// All parameters of a fit by name ("inertia", "viscous.coefficient"). ampere: the torque is known
// as a current only.
Json fitted_parameters(const FitResult& fit, bool ampere);

// Position zeros that differ from the first capture's (or, of captures that were not fitted, from
// the model's).
struct CaptureZero {
    std::string file;
    Estimate offset;
    std::string unit;
};
using Zeros = std::vector<CaptureZero>;
Zeros zeros_of(const Homing& homing, const std::vector<Capture>& captures);
// Only where there are any: "homing" in the JSON.
void add_homing(Json& out, const Zeros& zeros);

} // namespace servoid
