// servoid.diagnose/1 and servoid.refine/1: which physical effect is missing, and the ladder.
#pragma once

#include "answers/fit_json.hpp"
#include "diagnose/diagnose.hpp"

namespace servoid {

using Warnings = std::vector<std::string>;

Json diagnosis_json(const Diagnosis& d, const Warnings& warnings, const Zeros& zeros, bool ampere);
Json refinement_json(const Refinement& r, const Warnings& warnings, const Zeros& zeros,
                     bool ampere);

// Every key, of a capture that was refused before anything could be said.
Json no_diagnosis();
Json no_refinement();

// The zeros that hold with the effect that was found, else of the model as it is.
const Homing& homing_of(const Diagnosis& d);

} // namespace servoid
