// Where an instant is, by what a residual may be drawn against.
#pragma once

#include "compare/motion.hpp"

namespace servoid {

// On the grid; torque: what `torque` and `torque_rate` are of. Empty for a position that was not
// recorded; the velocity for in_phase and quadrature, which are no variables.
Eigen::VectorXd variable_of(Against against, const PreparedMotion& motion,
                            const Eigen::VectorXd& torque);

} // namespace servoid
