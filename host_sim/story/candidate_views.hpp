// Each candidate beside what it would explain. JSON: story.hpp, "candidates".
#pragma once

#include "diagnose/diagnose.hpp"
#include "story/scene.hpp"

namespace servoid {

// The first eight that were fitted. scene: of the model that they were added to.
Json candidate_views(const Diagnosis& diagnosis, const Scene& scene,
                     const std::vector<PreparedMotion>& motions);

} // namespace servoid
