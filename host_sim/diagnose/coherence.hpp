// How much of a residual follows the reference.
//
// In a closed loop noise goes round: what disturbs the torque moves the axis, and the loop answers.
// A residual that is nothing but noise is then correlated with torque and motion, and a delay, a
// lag or an elastic load seems to explain it. None of that noise is in the reference: what such
// dynamics really cause can be predicted from the reference's past.
#pragma once

#include "compare/motion.hpp"

#include <optional>

namespace servoid {

// Share of the residual's power (used points, as in FitResult) that the reference's acceleration at
// lags up to the loop's memory predicts on blocks it was not fitted to; nothing where a capture has
// no reference. Cost: some 80 columns.
std::optional<double> coherent_share(const Eigen::VectorXd& residual,
                                     const std::vector<PreparedMotion>& motions,
                                     const std::vector<int>& block);

} // namespace servoid
