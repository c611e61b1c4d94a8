// What can be done to a step: each makes the next one.
#pragma once

#include "studio/step.hpp"

namespace servoid::studio {

// All throw UsageError where it makes no sense and Refusal where the captures cannot show it.
StepPtr add(const Step& from, const std::string& effect);
StepPtr add_law(const Step& from, const std::string& name, const std::string& law);
// index: of the terms as they are listed, those that are off after those that are on.
StepPtr remove(const Step& from, size_t index);
StepPtr turn(const Step& from, size_t index, bool on);
// name: "inertia", "viscous.coefficient", "cogging#2.amplitude".
StepPtr set(const Step& from, const std::string& name, double value);
StepPtr fix(const Step& from, const std::string& name, bool fixed);
StepPtr fit_again(const Step& from);
StepPtr with_material(const Step& from, std::shared_ptr<const Material> material,
                      const std::string& what);
// The same step with what was found of it.
StepPtr diagnosed(const Step& from, const DiagnoseOptions& options);
StepPtr refined(const Step& from, const DiagnoseOptions& options);

} // namespace servoid::studio
