#include "identify/sweep.hpp"

#include "compare/solve.hpp"

#include <Eigen/Core>

#include <cmath>
#include <numbers>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

// J(x) for x = (ω/ω_top)²; parameters J, a = 1/ωa², b = 1/ωr², in units of 1/ω_top².
Vector law(const Vector& x, const Vector& p) {
    const double a = p.size() > 1 ? p[1] : 0, b = p.size() > 2 ? p[2] : 0;
    return p[0] * (1 - b * x.array()) / (1 - a * x.array());
}

Matrix slopes(const Vector& x, const Vector& p) {
    Matrix out(x.size(), p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
        Vector q = p;
        const double step = k == 0 ? 1e-6 * p[0] : 1e-6;
        q[k] += step;
        out.col(k) = (law(x, q) - law(x, p)) / step;
    }
    return out;
}

struct Fit {
    Vector p;
    Matrix covariance;
    double chi2 = 0;
};

// J_i (1 − a x) = J (1 − b x) is linear in J, a and J·b: where the descent starts.
Vector start(const Vector& x, const Vector& j, const Vector& weight, Eigen::Index unknowns) {
    Matrix columns(x.size(), 3);
    columns << Vector::Ones(x.size()), j.cwiseProduct(x), -x;
    const Matrix used = weight.asDiagonal() * columns.leftCols(unknowns);
    Vector p = least_squares(used, j.cwiseProduct(weight));
    if (unknowns > 1) p[1] = std::clamp(p[1], 0.0, 0.9);
    if (unknowns > 2) p[2] = std::clamp(p[2] / p[0], 0.0, p[1]);
    return p;
}

// Gauss-Newton with step halving; 0 ≤ b ≤ a < 0.9 keeps the poles above the sweep.
Fit descend(const Vector& x, const Vector& j, const Vector& weight, const Vector& from) {
    const Eigen::Index unknowns = from.size();
    Fit fit;
    fit.p = from;
    const auto miss = [&](const Vector& p) {
        return (law(x, p) - j).cwiseProduct(weight).squaredNorm();
    };
    for (int iteration = 0; iteration < 60; ++iteration) {
        const Matrix s = weight.asDiagonal() * slopes(x, fit.p);
        const Vector r = (j - law(x, fit.p)).cwiseProduct(weight);
        const Vector full = least_squares(s, r);
        double step = 1;
        Vector next = fit.p;
        for (; step > 1e-6; step /= 2) {
            next = fit.p + step * full;
            if (unknowns > 1) next[1] = std::clamp(next[1], 0.0, 0.9);
            if (unknowns > 2) next[2] = std::clamp(next[2], 0.0, next[1]);
            if (miss(next) < miss(fit.p)) break;
        }
        if (step <= 1e-6) break;
        fit.p = next;
    }
    fit.chi2 = miss(fit.p);
    const Matrix s = weight.asDiagonal() * slopes(x, fit.p);
    fit.covariance = pseudo_inverse(s.transpose() * s);
    return fit;
}

// a = b is a ridge on which the two cannot be told apart and a descent stays: several starts beside
// it.
Fit solve(const Vector& x, const Vector& j, const Vector& weight, Eigen::Index unknowns) {
    const Vector first = start(x, j, weight, unknowns);
    Fit best = descend(x, j, weight, first);
    for (const double a : {0.05, 0.2, 0.5}) {
        if (unknowns < 3) break;
        Vector from = first;
        from[1] = a, from[2] = 0.4 * a;
        const Fit fit = descend(x, j, weight, from);
        if (fit.chi2 < best.chi2) best = fit;
    }
    return best;
}

} // namespace

CorrectedInertia remove_elastic_bias(const std::vector<double>& frequency_Hz,
                                     const std::vector<double>& inertia,
                                     const std::vector<double>& std) {
    CorrectedInertia out;
    const auto n = Eigen::Index(frequency_Hz.size());
    if (n == 0) return out;
    const double top = frequency_Hz.back();
    Vector x(n), j(n), weight(n);
    const double mean = Eigen::Map<const Vector>(inertia.data(), n).mean();
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] = std::pow(frequency_Hz[size_t(i)] / top, 2);
        j[i] = inertia[size_t(i)];
        // What is left of the transient is no smaller than this, whatever the noise; an unknown
        // error counts as 2 %.
        const double own = std::isfinite(std[size_t(i)]) ? std[size_t(i)] : 2e-2 * mean;
        weight[i] = 1 / std::hypot(own, 2e-3 * mean);
    }
    // All three unknowns or J alone: 1/ωa² without 1/ωr² would place the antiresonance too high.
    Fit best = solve(x, j, weight, 1);
    if (n > 6) {
        const Fit elastic = solve(x, j, weight, 3);
        const double spread = std::max(1.0, elastic.chi2 / double(n - 3));
        if ((best.chi2 - elastic.chi2) / spread > 9.2) best = elastic; // 1 % by chance
    }
    const double scale = std::max(1.0, best.chi2 / std::max(1.0, double(n - best.p.size())));
    out.inertia = {best.p[0], std::sqrt(scale * best.covariance(0, 0))};
    out.scatter = std::sqrt(((law(x, best.p) - j) / best.p[0]).squaredNorm() / double(n));
    if (best.p.size() > 1 && best.p[1] > 0) {
        const double a = best.p[1], f = top / std::sqrt(a);
        out.antiresonance_Hz = Estimate{f, f / (2 * a) * std::sqrt(scale * best.covariance(1, 1))};
    }
    return out;
}

} // namespace servoid
