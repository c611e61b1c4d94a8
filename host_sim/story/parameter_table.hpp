// The parameters of a fit as the columns of a table. JSON: story.hpp, "parameters".
#pragma once

#include "answers/json.hpp"
#include "compare/regression.hpp"

namespace servoid {

// given: the model as it came, for the values that were believed.
Json parameter_table(const FitResult& fit, const Model& given, bool ampere);

} // namespace servoid
