// The residual seen from several sides. JSON: story.hpp.
#pragma once

#include "compare/noise_floor.hpp"
#include "story/scene.hpp"

namespace servoid {

Json against_json(const Scene& scene);
Json spectrum_json(const Scene& scene, double noise_floor);
Json orders_json(const Scene& scene);
Json response_json(const Scene& scene);

} // namespace servoid
