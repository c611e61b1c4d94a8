#include "diagnose/coherence.hpp"

#include "diagnose/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace servoid {

namespace {

constexpr double kMemory_s = 0.1; // of a position loop
constexpr int kMostLags = 80;
constexpr double kRidge = 1e-4; // neighbouring lags are nearly alike

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// The reference's acceleration through the band limit, `lag_s` ago, on the used points.
Vector reference_at(const PreparedMotion& m, double lag_s) {
    const Capture& capture = *m.capture;
    const Eigen::Map<const Vector> reference(capture.position_ref.data(),
                                             Eigen::Index(capture.rows()));
    return m.used_rows(m.low_pass->apply(reference, m.grid, 2, lag_s));
}

} // namespace

std::optional<double> coherent_share(const Vector& residual,
                                     const std::vector<PreparedMotion>& motions,
                                     const std::vector<int>& block) {
    double band_Hz = 0;
    for (const PreparedMotion& m : motions) {
        if (m.capture->position_ref.empty() || !m.capture->uniform) return std::nullopt;
        band_Hz = std::max(band_Hz, m.band_Hz);
    }
    const double step_s = std::max(1 / (3 * band_Hz), kMemory_s / kMostLags);
    const int lags = std::max(4, int(kMemory_s / step_s));
    Matrix columns(residual.size(), lags + 3);
    for (int lag = -2; lag <= lags; ++lag) {
        Eigen::Index row = 0;
        for (const PreparedMotion& m : motions) {
            const Vector part = reference_at(m, lag * step_s);
            columns.col(lag + 2).segment(row, part.size()) = part;
            row += part.size();
        }
    }
    const std::vector<double> unseen = held_out_power(columns, residual, block, kRidge);
    const double left = std::accumulate(unseen.begin(), unseen.end(), 0.0);
    return std::max(0.0, 1 - left / residual.squaredNorm());
}

} // namespace servoid
