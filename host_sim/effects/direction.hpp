// The sign of a measured velocity.
#pragma once

#include "effects/effect.hpp"

namespace servoid {

// sgn v as the mean over a sample's width, in which the velocity crosses zero at the measured
// acceleration; rounded off over the noise of v too, so that a velocity that is only noise counts
// as zero on average instead of as full friction one way and the other.
inline Eigen::VectorXd direction(const MotionView& motion) {
    const Eigen::ArrayXd crossing = motion.acceleration.array().abs() * motion.sample_time_s / 2;
    const Eigen::ArrayXd width = crossing.max(2 * motion.velocity_noise).max(1e-300);
    return (motion.velocity.array() / width).max(-1.0).min(1.0);
}

} // namespace servoid
