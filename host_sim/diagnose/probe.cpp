#include "diagnose/probe.hpp"

#include "diagnose/evidence.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kKnots = 12;

// All captures, used points only, in the order of the residual.
struct Scene {
    Vector time, position, velocity, acceleration;
};

Scene scene_of(const std::vector<PreparedMotion>& motions, const Homing& homing) {
    Scene out;
    Eigen::Index rows = 0;
    for (const PreparedMotion& m : motions)
        rows += m.used_count();
    for (Vector* v : {&out.time, &out.position, &out.velocity, &out.acceleration})
        *v = Vector::Zero(rows);
    Eigen::Index row = 0;
    for (size_t i = 0; i < motions.size(); ++i) {
        const PreparedMotion& m = motions[i];
        for (Eigen::Index k = 0; k < m.grid.count; ++k) {
            if (!m.used[size_t(k)]) continue;
            out.time[row] = m.grid.at(k);
            if (m.position.size()) out.position[row] = m.position[k] + homing.of(i);
            out.velocity[row] = m.velocity[k], out.acceleration[row] = m.acceleration[k];
            ++row;
        }
    }
    return out;
}

std::vector<double> knots_of(const Vector& x) {
    std::vector<double> sorted(x.begin(), x.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> out;
    for (int k = 0; k < kKnots; ++k) {
        const double at = double(k) / (kKnots - 1) * double(sorted.size() - 1);
        const double knot = sorted[size_t(at)];
        if (out.empty() || knot > out.back()) out.push_back(knot);
    }
    return out;
}

// Hat functions of x on the knots, each times the factor.
Matrix hats(const Vector& x, const Vector& factor) {
    const std::vector<double> knots = knots_of(x);
    Matrix out = Matrix::Zero(x.size(), Eigen::Index(knots.size()));
    if (knots.size() < 3) return Matrix(x.size(), 0);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto above = std::upper_bound(knots.begin(), knots.end(), x[i]);
        const auto j = std::clamp<long>(above - knots.begin(), 1, long(knots.size()) - 1);
        const double share = std::clamp(
            (x[i] - knots[size_t(j - 1)]) / (knots[size_t(j)] - knots[size_t(j - 1)]), 0.0, 1.0);
        out(i, j - 1) = (1 - share) * factor[i];
        out(i, j) = share * factor[i];
    }
    return out;
}

// No function of the torque: it would explain itself.
struct Basis {
    const char* name;
    Vector factor; // alone it says nothing of the variable
    Matrix columns;
};

Basis basis(const char* name, const Vector& x, const Vector& factor) {
    return {name, factor, hats(x, factor)};
}

std::vector<Basis> bases(const Scene& s) {
    const Vector one = Vector::Ones(s.time.size()), sign = s.velocity.cwiseSign();
    std::vector<Basis> out = {basis("velocity", s.velocity, one), basis("time", s.time, one),
                              basis("acceleration × time", s.time, s.acceleration),
                              basis("direction × time", s.time, sign)};
    if (s.position.squaredNorm() > 0) {
        out.push_back(basis("position", s.position, one));
        out.push_back(basis("acceleration × position", s.position, s.acceleration));
        out.push_back(basis("direction × position", s.position, sign));
    }
    return out;
}

} // namespace

std::vector<Probe> probe_residual(const FitResult& fit, Assembler& assembler) {
    const Matrix base = joint_slopes(fit, assembler);
    const Scene scene = scene_of(assembler.motions(), fit.homing);
    std::vector<Probe> out;
    for (const Basis& b : bases(scene)) {
        Matrix alone(base.rows(), base.cols() + 1);
        alone << base, b.factor;
        const std::vector<double> before = held_out_power(alone, fit.residual, assembler.blocks());
        const double total = std::accumulate(before.begin(), before.end(), 0.0);
        if (b.columns.cols() == 0 || !(total > 0)) continue;
        Matrix slopes(base.rows(), base.cols() + b.columns.cols());
        slopes << base, b.columns;
        const std::vector<double> after = held_out_power(slopes, fit.residual, assembler.blocks());
        Probe probe;
        probe.name = b.name;
        probe.explained = 1 - std::accumulate(after.begin(), after.end(), 0.0) / total;
        probe.z = gain_z(before, after);
        out.push_back(probe);
    }
    std::sort(out.begin(), out.end(),
              [](const Probe& a, const Probe& b) { return a.explained > b.explained; });
    return out;
}

} // namespace servoid
