// The loop view: the model in its loop, given the recorded reference, against the record.
#pragma once

#include "compare/compare.hpp"

namespace servoid {

// Nothing without a controller or a position reference, or where the loop runs at another rate than
// the capture by more than 1 %.
std::optional<LoopError> loop_view(const Model& model, const Capture& capture);

} // namespace servoid
