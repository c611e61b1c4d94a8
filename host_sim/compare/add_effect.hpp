// Adding one effect to a model: fitted together with everything else.
#pragma once

#include "compare/regression.hpp"

namespace servoid {

struct Addition {
    FitResult before; // the model as it was, fitted again: a wrong inertia is no missing effect
    FitResult after;
};

// Throws UsageError where the effect is unknown or cannot stand in the model. An effect that stands
// for another (viscous_asymmetric for viscous) takes its place.
Addition add_effect(const Model& model, const std::string& effect,
                    const std::vector<PreparedMotion>& motions);

} // namespace servoid
