#include "studio/step.hpp"

#include "compare/homing_search.hpp"
#include "diagnose/sanity.hpp"
#include "story/story.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace servoid::studio {

namespace {

// What was found holds for the very model only.
void forget(Step& step) { step.diagnosis.reset(), step.refinement.reset(); }

} // namespace

StepPtr as_it_is(Step step) {
    forget(step), step.fit.reset();
    step.torque_error = torque_error_of(step.model, step.material->motions());
    return std::make_shared<const Step>(std::move(step));
}

StepPtr with_fit(Step step, FitResult fit) {
    forget(step);
    step.model = fit.model;
    step.torque_error = fit.torque_error;
    step.fit = std::move(fit);
    return std::make_shared<const Step>(std::move(step));
}

StepPtr fitted(Step step) {
    Assembler assembler(step.material->motions());
    FitResult fit = fit_homed(step.model, assembler);
    return with_fit(std::move(step), std::move(fit));
}

std::vector<std::string> warnings_of(const Model& model, const Material& material) {
    return warnings_or_refusal(suspicions(model, material.motions()));
}

Json story_of(const Step& step, const Model& given, const Provenance& provenance) {
    const FitResult* fit = step.fit ? &*step.fit : nullptr;
    return make_story({given, step.material->motions(), step.model, fit, step.diagnosis.get(),
                       step.refinement.get(), step.warnings, provenance});
}

} // namespace servoid::studio
