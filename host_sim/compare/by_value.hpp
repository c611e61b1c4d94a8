// Where the model fails, by the value of what the laws depend on: signed velocity, position,
// acceleration, and the torque of the model.
//
// The mean of the residual against such a value is the missing law itself, smoothed over the bin: a
// step at zero velocity is Coulomb friction, a straight line through zero viscous friction.
#pragma once

#include "compare/where.hpp"

#include <vector>

namespace servoid {

// What the model leaves of one capture, on its grid.
struct ResidualView {
    const PreparedMotion& motion;
    const Eigen::VectorXd& residual;     // T − T̂
    const Eigen::VectorXd& model_torque; // T̂
};

// Groups "velocity", "position", "acceleration" and "torque": bins of equal width between the
// extremes of all captures together, lowest first, shares adding up to 1. Bins with less than 0.5 %
// of the used samples are joined with the emptier one of their neighbours. No group of a value that
// is not recorded or does not vary.
std::vector<Regime> where_by_value(const std::vector<ResidualView>& captures);

} // namespace servoid
