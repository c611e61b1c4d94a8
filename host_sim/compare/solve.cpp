#include "compare/solve.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace servoid {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Vector solve_symmetric(const Matrix& a, const Vector& b) { return a.ldlt().solve(b); }
Matrix solve_symmetric(const Matrix& a, const Matrix& b) { return a.ldlt().solve(b); }

Vector least_squares(const Matrix& a, const Vector& b) { return a.colPivHouseholderQr().solve(b); }
Vector shortest_least_squares(const Matrix& a, const Vector& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}

Matrix pseudo_inverse(const Matrix& a) {
    return a.completeOrthogonalDecomposition().pseudoInverse();
}

} // namespace servoid
