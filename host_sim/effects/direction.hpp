// The sign of a measured velocity.
#pragma once

#include "effects/effect.hpp"

namespace servoid {

// sgn v, rounded off over the noise of v so that a velocity that is only noise counts as zero on
// average instead of as full friction one way and the other.
inline Eigen::VectorXd direction(const MotionView& motion) {
    const double width = motion.velocity_noise;
    if (width <= 0) return motion.velocity.cwiseSign();
    return (motion.velocity / (2 * width)).cwiseMax(-1.0).cwiseMin(1.0);
}

} // namespace servoid
