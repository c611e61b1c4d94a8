// Whether the axis ever turns round, and who drives whom.
#pragma once

#include "compare/motion.hpp"

#include <vector>

namespace servoid {

// Less than 2 % of the way, all captures together, goes against the rest: Coulomb friction and a
// constant torque are then the same thing.
bool moves_one_way(const std::vector<PreparedMotion>& motions);

// Work of the recorded torque over the size of its power: above zero where the axis takes it up. An
// axis with friction always does, a reversed torque never; a spring that the model lacks turns the
// sign of a fitted inertia, but not that of the work.
double work_share(const std::vector<PreparedMotion>& motions);

} // namespace servoid
