// How noisy a sampled signal is, without a model of what it measures.
#pragma once

#include <Eigen/Core>

namespace servoid {

// Standard deviation per sample of white noise on a smooth signal: the robust spread of its third
// difference over √20, but at least the quantisation noise quantum/√12 where a quantum is known.
double sample_noise(const Eigen::VectorXd& signal, double quantum);

// Root of the mean square; 0 of nothing.
double rms(const Eigen::VectorXd& x);

} // namespace servoid
