#include "compare/noise_floor.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr long kFewest = 16; // points that are used in every period, or pairs of points

// One row per whole period; points that are not used anywhere in their column are zero everywhere.
Eigen::MatrixXd by_period(const PreparedMotion& m, const Vector& residual, Eigen::Index points) {
    const Eigen::Index periods = residual.size() / points;
    Eigen::MatrixXd out(periods, points);
    for (Eigen::Index j = 0; j < points; ++j) {
        bool all = true;
        for (Eigen::Index p = 0; p < periods; ++p)
            all &= m.used[size_t(p * points + j)];
        for (Eigen::Index p = 0; p < periods; ++p)
            out(p, j) = all ? residual[p * points + j] : 0.0;
    }
    return out;
}

Eigen::MatrixXd without_transient(Eigen::MatrixXd rows) {
    while (rows.rows() > 3) {
        const Vector mean = rows.bottomRows(rows.rows() - 1).colwise().mean();
        const double first = (rows.row(0).transpose() - mean).squaredNorm();
        std::vector<double> rest;
        for (Eigen::Index p = 1; p < rows.rows(); ++p)
            rest.push_back((rows.row(p).transpose() - mean).squaredNorm());
        std::nth_element(rest.begin(), rest.begin() + long(rest.size() / 2), rest.end());
        if (first <= 9 * rest[rest.size() / 2]) break;
        rows = rows.bottomRows(rows.rows() - 1).eval();
    }
    return rows;
}

double torque_rms(const PreparedMotion& m) {
    const Eigen::Index n = m.used_count();
    return n ? std::sqrt(m.used_power(m.torque) / double(n)) : 0;
}

// Less than two whole periods, or hardly a point that is used in all of them: what differs between
// the instants that are a period apart.
NoiseFloor from_overlap(const PreparedMotion& m, const Vector& residual, Eigen::Index points) {
    double difference = 0, power = 0;
    long pairs = 0;
    for (Eigen::Index k = 0; k + points < residual.size(); ++k) {
        if (!m.used[size_t(k)] || !m.used[size_t(k + points)]) continue;
        difference += std::pow(residual[k + points] - residual[k], 2) / 2;
        power += (std::pow(residual[k], 2) + std::pow(residual[k + points], 2)) / 2;
        ++pairs;
    }
    NoiseFloor out;
    out.from_repetition = pairs >= kFewest;
    if (!out.from_repetition) return out;
    out.periods = 2;
    out.ratio = std::sqrt(difference / double(pairs)) / torque_rms(m);
    out.repeatable_share = power > 0 ? std::clamp(1 - difference / power, 0.0, 1.0) : 0;
    return out;
}

NoiseFloor from_repetition(const PreparedMotion& m, const Vector& residual, Eigen::Index points) {
    const Eigen::MatrixXd rows = without_transient(by_period(m, residual, points));
    const auto periods = double(rows.rows());
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    const double used = double((rows.row(0).array() != 0).count());
    if (used < kFewest) return from_overlap(m, residual, points);
    const double noise = (rows.rowwise() - mean).squaredNorm() / (periods - 1) / used;
    const double total = rows.squaredNorm() / periods / used;
    NoiseFloor out;
    out.from_repetition = true;
    out.periods = int(rows.rows());
    out.ratio = std::sqrt(noise) / torque_rms(m);
    out.repeatable_share = total > 0 ? std::clamp(1 - noise / total, 0.0, 1.0) : 0;
    return out;
}

} // namespace

NoiseFloor noise_floor(const PreparedMotion& m, const Vector& residual, double inertia) {
    // A motion that repeats to the count repeats its quantisation too.
    const double quantisation =
        std::hypot(inertia * m.acceleration_noise, m.torque_noise) / torque_rms(m);
    NoiseFloor out;
    if (m.period_s) { // the grid has a whole number of points to the period
        const auto points = Eigen::Index(std::lround(*m.period_s / m.grid.step_s));
        out = residual.size() >= 2 * points ? from_repetition(m, residual, points)
                                            : from_overlap(m, residual, points);
    }
    out.ratio = std::max(out.ratio, quantisation);
    return out;
}

} // namespace servoid
