// Eigen's solvers for matrices of any size, each compiled once: a file that calls one of them by
// itself takes seconds more. Results are those of the solvers, to the last bit.
#pragma once

#include <Eigen/Core>

namespace servoid {

// x of a·x = b for a symmetric positive a, as a.ldlt() solves it.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// x with the least |a·x − b|: by columns turned in the order of their weight (full rank), ...
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
// ... and the shortest such x where columns depend on each other.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

} // namespace servoid
