#include "compare/where.hpp"

#include "compare/spectrum.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kReversalSpeed = 0.05; // of the top speed
constexpr double kAccelerating = 0.2;   // of the top acceleration
constexpr int kSpeedRanges = 3;
constexpr int kTimeParts = 6;
constexpr int kOrders = 3; // strongest position orders that are reported

struct Scene {
    const PreparedMotion& m;
    const Vector& residual;
    const char* speed_unit;
    double top_speed = 0, top_acceleration = 0;
};

// The 95th percentile: a peak that one noisy sample makes is no scale.
double typical_top(const Vector& x) {
    std::vector<double> size(size_t(x.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i)
        size[size_t(i)] = std::abs(x[i]);
    const auto at = size.begin() + long(0.95 * double(size.size() - 1));
    std::nth_element(size.begin(), at, size.end());
    return *at;
}

std::string motion_regime(const Scene& s, Eigen::Index k) {
    const double speed = std::abs(s.m.velocity[k]);
    if (speed < kReversalSpeed * s.top_speed) return "reversal";
    if (std::abs(s.m.acceleration[k]) > kAccelerating * s.top_acceleration)
        return s.m.acceleration[k] * s.m.velocity[k] > 0 ? "acceleration" : "braking";
    const double width = s.top_speed / kSpeedRanges;
    const int range = std::min(kSpeedRanges - 1, int(speed / width));
    return fmt::format("cruise {:.3g}…{:.3g} {}", range * width, (range + 1) * width, s.speed_unit);
}

std::string time_part(const Scene& s, Eigen::Index k) {
    const int part = int(k * kTimeParts / s.m.grid.count);
    const double length = double(s.m.grid.count) * s.m.grid.step_s / kTimeParts;
    const double from = s.m.grid.start_s + part * length;
    return fmt::format("time {:.3g}…{:.3g} s", from, from + length);
}

using Label = std::function<std::string(Eigen::Index)>;

void add_group(const Scene& s, const std::string& group, const Label& label,
               std::vector<Regime>& out) {
    std::map<std::string, std::pair<double, double>> sums;
    std::vector<std::string> order;
    double power = 0, count = 0;
    for (Eigen::Index k = 0; k < s.residual.size(); ++k) {
        if (!s.m.used[size_t(k)]) continue;
        const std::string name = label(k);
        if (!sums.count(name)) order.push_back(name);
        const double r2 = s.residual[k] * s.residual[k];
        sums[name].first += r2, sums[name].second += 1;
        power += r2, count += 1;
    }
    for (const std::string& name : order)
        out.push_back(
            {group, name, power > 0 ? sums[name].first / power : 0, sums[name].second / count});
}

void add_frequencies(const Scene& s, std::vector<Regime>& out) {
    const Spectrum spectrum = power_spectrum(s.residual, s.m.grid.step_s);
    const double total = spectrum.power.sum();
    double from = 0;
    for (double part : {0.05, 0.15, 0.4, 1.0}) {
        const double to = part * s.m.band_Hz;
        double power = 0;
        for (Eigen::Index k = 0; k < spectrum.power.size(); ++k) {
            const double f = double(k) * spectrum.step_Hz;
            if (f >= from && (f < to || part == 1.0)) power += spectrum.power[k];
        }
        out.push_back({"frequency", fmt::format("frequency {:.3g}…{:.3g} Hz", from, to),
                       total > 0 ? power / total : 0, (to - from) / s.m.band_Hz});
        from = to;
    }
}

// Share of the residual's power that a·cos(κθ) + b·sin(κθ) + c explains beyond a constant.
double explained_by_order(const Scene& s, double per_unit) {
    const double k = 2 * std::numbers::pi * per_unit;
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double power = 0, mean = 0, count = 0;
    for (Eigen::Index i = 0; i < s.residual.size(); ++i) {
        if (!s.m.used[size_t(i)]) continue;
        const Eigen::Vector3d x(std::cos(k * s.m.position[i]), std::sin(k * s.m.position[i]), 1);
        gram += x * x.transpose();
        moment += s.residual[i] * x;
        power += s.residual[i] * s.residual[i], mean += s.residual[i], count += 1;
    }
    const double around_mean = power - mean * mean / count;
    const double explained = moment.dot(gram.ldlt().solve(moment)) - mean * mean / count;
    return around_mean > 0 ? explained / around_mean : 0;
}

struct Line {
    double per_unit, share;
};

// Orders per unit of position: at least two cycles in the travel, at most what the speed lets
// through the band. A line is a local maximum of the explained share.
std::vector<Line> strongest_orders(const Scene& s) {
    const double travel = s.m.position.maxCoeff() - s.m.position.minCoeff();
    const double highest = 0.5 * s.m.band_Hz / std::max(1e-300, s.top_speed);
    const double step = 0.2 / travel;
    const int count = int(std::min(4000.0, highest / step));
    std::vector<double> share;
    for (int i = 10; i < count; ++i)
        share.push_back(explained_by_order(s, i * step));
    std::vector<Line> lines;
    for (size_t i = 1; i + 1 < share.size(); ++i)
        if (share[i] > share[i - 1] && share[i] >= share[i + 1])
            lines.push_back({double(i + 10) * step, share[i]});
    std::sort(lines.begin(), lines.end(),
              [](const Line& a, const Line& b) { return a.share > b.share; });
    if (lines.size() > kOrders) lines.resize(kOrders);
    return lines;
}

void add_orders(const Scene& s, std::vector<Regime>& out) {
    if (s.m.position.size() == 0) return;
    const bool linear = s.m.capture->linear;
    for (const Line& line : strongest_orders(s)) {
        const std::string name =
            linear ? fmt::format("order {:.4g} per m (period {:.4g} mm)", line.per_unit,
                                 1000 / line.per_unit)
                   : fmt::format("order {:.4g} per rev", line.per_unit * 2 * std::numbers::pi);
        // What two sines explain of white noise: two parts in the number of points.
        out.push_back({"position order", name, line.share, 2 / double(s.residual.size())});
    }
}

Scene scene_of(const PreparedMotion& motion, const Vector& residual) {
    return {motion, residual, motion.capture->linear ? "m/s" : "rad/s",
            motion.velocity.cwiseAbs().maxCoeff(), typical_top(motion.acceleration)};
}

} // namespace

std::vector<std::string> motion_regimes(const PreparedMotion& motion) {
    const Vector none;
    const Scene scene = scene_of(motion, none);
    std::vector<std::string> out;
    for (Eigen::Index k = 0; k < motion.grid.count; ++k)
        out.push_back(motion_regime(scene, k));
    return out;
}

std::vector<Regime> where_it_fails(const PreparedMotion& motion, const Vector& residual) {
    const Scene scene = scene_of(motion, residual);
    std::vector<Regime> out;
    add_group(
        scene, "regime", [&](Eigen::Index k) { return motion_regime(scene, k); }, out);
    std::sort(out.begin(), out.end(),
              [](const Regime& a, const Regime& b) { return a.residual_share > b.residual_share; });
    add_group(
        scene, "direction",
        [&](Eigen::Index k) { return motion.velocity[k] > 0 ? "forward" : "reverse"; }, out);
    add_frequencies(scene, out);
    add_orders(scene, out);
    add_group(
        scene, "time", [&](Eigen::Index k) { return time_part(scene, k); }, out);
    return out;
}

} // namespace servoid
