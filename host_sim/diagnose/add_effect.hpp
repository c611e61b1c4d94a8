// One more effect in a model, fitted together with everything else.
#pragma once

#include "compare/regression.hpp"

namespace servoid {

struct Addition {
    FitResult before; // the model as it was, fitted again: a wrong inertia is no missing effect
    FitResult after;
};

// Throws UsageError where the effect is unknown or cannot stand in the model, Refusal where the
// captures cannot show it. An effect that stands for another (viscous_asymmetric for viscous) takes
// its place.
Addition add_effect(const Model& model, const std::string& effect,
                    const std::vector<PreparedMotion>& motions);

// The same for a law that the user wrote, its values being where a search starts. Without it there
// need not be a fit: the error before is then not a number.
Addition add_term(const Model& model, const EffectTerm& term,
                  const std::vector<PreparedMotion>& motions);

// The fit of `fitted` with the effect added, from the best of the effect's own starting points.
// Throws Refusal where the captures cannot show it.
FitResult fit_with(const FitResult& fitted, const Effect& effect, Assembler& assembler);

} // namespace servoid
