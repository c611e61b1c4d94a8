// One state of a studio: a model, its captures, and what was found of them. Never changed: every
// action makes another one, so that undo is a step back.
#pragma once

#include "answers/json.hpp"
#include "diagnose/diagnose.hpp"
#include "studio/material.hpp"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace servoid::studio {

struct Step {
    std::string what; // "opened", "+ coulomb", "viscous.coefficient = 2"
    Model model;      // the terms that are on
    std::vector<EffectTerm> off;
    std::shared_ptr<const Material> material;
    std::optional<FitResult> fit; // none while the numbers are the user's
    double torque_error = 0;
    std::shared_ptr<const Diagnosis> diagnosis;   // of this very model
    std::shared_ptr<const Refinement> refinement; // that has led here
    std::vector<std::string> warnings;
};
using StepPtr = std::shared_ptr<const Step>;

// The step with these numbers and captures, its error evaluated; nothing is fitted.
StepPtr as_it_is(Step step);
// Everything that is not fixed fitted to the captures. Throws Refusal.
StepPtr fitted(Step step);
StepPtr with_fit(Step step, FitResult fit);

// Whether the captures are what they say (diagnose/sanity.hpp): warnings, or a Refusal.
std::vector<std::string> warnings_of(const Model& model, const Material& material);

// servoid.story/1. given: the model that was opened; what was believed.
Json story_of(const Step& step, const Model& given, const Provenance& provenance);

} // namespace servoid::studio
