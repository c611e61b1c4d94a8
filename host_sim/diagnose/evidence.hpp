// How much a fit is worth: on data it was not fitted to, and against its number of parameters.
#pragma once

#include "compare/regression.hpp"

#include <Eigen/Core>

#include <vector>

namespace servoid {

// Squared error of each block, predicted by the fit to all other blocks (linearised: slopes are the
// columns of everything that was fitted). ridge: of the largest squared column, for columns that
// are nearly alike.
std::vector<double> held_out_power(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& residual,
                                   const std::vector<int>& block, double ridge = 1e-9);

// ‖T − T̂‖/‖T‖ with each block predicted by the fit to all others.
double held_out_error(const FitResult& fit, Assembler& assembler);

// How many independent numbers a residual holds, from the flatness of its spectrum: N for white
// noise up to the Nyquist frequency, few for a residual that repeats or drifts.
double effective_count(const Eigen::VectorXd& residual);

} // namespace servoid
