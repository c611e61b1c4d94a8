// How much a fit is worth: on data it was not fitted to, and against its number of parameters.
#pragma once

#include "compare/regression.hpp"
#include "compare/spectrum.hpp" // effective_count

#include <Eigen/Core>

#include <vector>

namespace servoid {

// Squared error of each block, predicted by the fit to all other blocks (linearised: slopes are the
// columns of everything that was fitted). ridge: of the largest squared column, for columns that
// are nearly alike.
std::vector<double> held_out_power(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& residual,
                                   const std::vector<int>& block, double ridge = 1e-5);

// What each block shows beyond what the fit to all others could foresee of it: e'·(I +
// X·G⁻¹·X')⁻¹·e of its error e, its slopes X, and the others' Gram matrix G. Where one block alone
// tells a parameter, its error says little, and here it counts little.
double foreseen_power(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& residual,
                      const std::vector<int>& block, double ridge = 1e-5);

// Fourth moment over the squared second: 3 of Gaussian noise.
double peakedness(const Eigen::VectorXd& residual);

// Squared error of each block as a share of ‖T‖², predicted by the fit to all others.
std::vector<double> held_out_blocks(const FitResult& fit, Assembler& assembler);
struct HeldOut {
    std::vector<double> blocks; // held_out_blocks
    double foreseen = 0;        // ‖T − T̂‖/‖T‖ by foreseen_power
};
HeldOut held_out(const FitResult& fit, Assembler& assembler);
// ‖T − T̂‖/‖T‖ with each block predicted by the fit to all others.
double held_out_error(const FitResult& fit, Assembler& assembler);
double error_of(const std::vector<double>& blocks);

// By how many of its standard errors, from block to block, the sum of `before` exceeds `after`.
double gain_z(const std::vector<double>& before, const std::vector<double>& after);

} // namespace servoid
