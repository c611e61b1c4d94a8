#include "compare/linear_fit.hpp"

#include "compare/solve.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kWorstCondition = 1e6;

// Normal equations of columns scaled to length 1: exact enough up to the condition that is allowed,
// and a hundred times cheaper than an orthogonal factorisation of a long record.
struct Normal {
    Vector scale;
    Matrix gram;
    Vector moment;
};

Normal normal_of(const LinearProblem& p) {
    Normal n;
    n.scale = p.columns.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    n.gram = n.scale.asDiagonal() * (p.columns.transpose() * p.columns) * n.scale.asDiagonal();
    n.moment = n.scale.asDiagonal() * (p.columns.transpose() * p.target);
    return n;
}

} // namespace

Matrix pick(const Matrix& columns, const std::vector<int>& which) {
    Matrix out(columns.rows(), Eigen::Index(which.size()));
    for (size_t i = 0; i < which.size(); ++i)
        out.col(Eigen::Index(i)) = columns.col(which[i]);
    return out;
}

double condition_of(const Matrix& x) {
    if (x.cols() < 2) return 1;
    // A vector first: as an expression it would be evaluated once for every entry of x.
    const Vector scale = x.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Matrix scaled = x * scale.asDiagonal();
    const Vector power =
        Eigen::SelfAdjointEigenSolver<Matrix>(scaled.transpose() * scaled).eigenvalues();
    return power[0] > 0 ? std::sqrt(power[power.size() - 1] / power[0]) : INFINITY;
}

LinearFit solve(const LinearProblem& p) {
    LinearFit out;
    out.values = p.given;
    for (int i = 0; i < int(p.fixed.size()); ++i)
        if (!p.fixed[size_t(i)]) out.free.push_back(i);
    const Normal n = normal_of(p);
    while (!out.free.empty()) {
        const auto k = Eigen::Index(out.free.size());
        Vector given = out.values;
        for (int i : out.free)
            given[i] = 0;
        const Vector known = n.gram * given.cwiseQuotient(n.scale);
        Matrix gram(k, k);
        Vector moment(k);
        for (Eigen::Index i = 0; i < k; ++i) {
            const int row = out.free[size_t(i)];
            moment[i] = n.moment[row] - known[row];
            for (Eigen::Index j = 0; j < k; ++j)
                gram(i, j) = n.gram(row, out.free[size_t(j)]);
        }
        const Eigen::SelfAdjointEigenSolver<Matrix> eigen(gram);
        const double least = eigen.eigenvalues()[0], most = eigen.eigenvalues()[k - 1];
        if (!(least * kWorstCondition * kWorstCondition > most)) return out;
        const Vector solved = solve_symmetric(gram, moment);
        Eigen::Index worst = -1;
        double worst_by = 0;
        for (Eigen::Index i = 0; i < k; ++i) {
            const int at = out.free[size_t(i)];
            out.values[at] = solved[i] * n.scale[at];
            const double by = (p.lower[size_t(at)] - out.values[at]) / n.scale[at];
            if (by > worst_by) worst_by = by, worst = i;
        }
        if (worst < 0) break;
        const int at = out.free[size_t(worst)];
        out.values[at] = p.lower[size_t(at)];
        out.on_bound.push_back(at);
        out.free.erase(out.free.begin() + worst);
    }
    out.solved = true;
    return out;
}

Matrix block_covariance(const Matrix& x, const Vector& residual, const std::vector<int>& block) {
    if (x.cols() == 0) return Matrix(0, 0);
    const int blocks = block.empty() ? 0 : block.back() + 1;
    const Vector scale = x.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Matrix scaled = x * scale.asDiagonal();
    Matrix scores = Matrix::Zero(blocks, x.cols());
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        scores.row(block[size_t(i)]) += residual[i] * scaled.row(i);
    const Matrix inverse = pseudo_inverse(scaled.transpose() * scaled);
    const double spread = double(blocks) / std::max(1.0, double(blocks) - double(x.cols()));
    const Matrix cov = inverse * (scores.transpose() * scores) * inverse * spread;
    return scale.asDiagonal() * cov * scale.asDiagonal();
}

} // namespace servoid
