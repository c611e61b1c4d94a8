// The stretches of time that hold most of the residual.
#pragma once

#include "story/scene.hpp"

namespace servoid {

// At most five that do not overlap, each a fortieth of the record long and holding at least 1.5
// times its share of the residual's power; worst first. JSON: story.hpp, "worst".
Json worst_json(const SceneCapture& capture);

} // namespace servoid
