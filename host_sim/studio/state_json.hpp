// The parts of servoid.studio/1 that show a step.
#pragma once

#include "studio/step.hpp"
#include "studio/worker.hpp"

namespace servoid::studio {

// {"inertia": P, "terms": [...]}, those that are off last.
Json terms_json(const Step& step);
Json recordings_json(const Recordings& recordings);
// The catalogue, with the reason why an effect cannot be added now.
Json effects_json(const Model& model);
Json busy_json(const std::optional<Busy>& busy);

} // namespace servoid::studio
