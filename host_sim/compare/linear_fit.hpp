// Linear least squares with lower bounds, and errors that hold for correlated residuals.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace servoid {

struct LinearFit {
    Eigen::VectorXd values;    // of all columns; given ones as given, bounded ones on the bound
    std::vector<int> free;     // columns that were solved for
    std::vector<int> on_bound; // columns that a bound stopped
    bool solved = false;       // false: the free columns cannot be told apart
};

struct LinearProblem {
    const Eigen::MatrixXd& columns;
    const Eigen::VectorXd& target;
    Eigen::VectorXd given; // value of each column that is not free
    std::vector<bool> fixed;
    std::vector<double> lower;
};

// Active set: a coefficient that leaves its bound is put on it and the rest is solved again.
LinearFit solve(const LinearProblem& problem);

// Of the columns scaled to length 1: largest over smallest singular value.
double condition_of(const Eigen::MatrixXd& columns);
Eigen::MatrixXd pick(const Eigen::MatrixXd& columns, const std::vector<int>& which);

// (XᵀX)⁻¹ (Σ over blocks of g gᵀ) (XᵀX)⁻¹, g = Xᵀr of the block.
Eigen::MatrixXd block_covariance(const Eigen::MatrixXd& x, const Eigen::VectorXd& residual,
                                 const std::vector<int>& block);

} // namespace servoid
