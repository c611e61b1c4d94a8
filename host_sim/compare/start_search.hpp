// Where the search for the shapes of a written law begins.
#pragma once

#include "compare/assembly.hpp"

namespace servoid {

// The model with each free shape of its written laws at the multiple of its start value that fits
// best, one shape after another. A start of 0 has no multiples. The other sign is taken only where
// it fits clearly better. Cost: ten linear fits per shape, twice where a law has several.
Model with_best_starts(Model model, Assembler& assembler);

// Whether a written law of the model depends on the torque, and so on its own coefficients.
bool feeds_back(const Model& model);
// The model with the free coefficients of such laws at 0: their start values mean nothing, and a
// wrong one would begin with a wrong torque.
Model without_start_torque(Model model);

} // namespace servoid
