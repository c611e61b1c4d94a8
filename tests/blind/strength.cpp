#include "blind/strength.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blind {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

Vector as_vector(const std::vector<double>& v) {
    return Eigen::Map<const Vector>(v.data(), static_cast<Index>(v.size()));
}

// A sinc under a Blackman window, half its height at the band edge, on every `stride`-th sample.
class Smoother {
  public:
    Smoother(double step_s, double band_Hz) {
        reach_ = static_cast<Index>(3 / band_Hz / step_s) + 1;
        stride_ = std::max<Index>(1, static_cast<Index>(1 / (4 * band_Hz * step_s)));
        taps_ = Vector(2 * reach_ + 1);
        for (Index i = -reach_; i <= reach_; ++i) {
            const double x = kTurn * band_Hz * step_s * static_cast<double>(i);
            const double u = kTurn * static_cast<double>(i) / (2.0 * static_cast<double>(reach_));
            const double window = 0.42 + 0.5 * std::cos(u) + 0.08 * std::cos(2 * u);
            taps_[i + reach_] = window * (i == 0 ? 1 : std::sin(x) / x);
        }
        taps_ /= taps_.sum();
    }
    Vector operator()(const Vector& x) const {
        const Index n = std::max<Index>(0, (x.size() - 2 * reach_ - 4) / stride_);
        Vector out(n);
        for (Index k = 0; k < n; ++k)
            out[k] = taps_.dot(x.segment(2 + k * stride_, taps_.size()));
        return out;
    }

  private:
    Index reach_ = 0, stride_ = 1;
    Vector taps_;
};

// Mean acceleration over [k, k+1] and mean velocity that samples of a position say.
Vector acceleration_of(const Vector& x, double h) {
    Vector out = Vector::Zero(x.size());
    for (Index k = 1; k + 2 < x.size(); ++k)
        out[k] = (x[k + 2] - x[k + 1] - x[k] + x[k - 1]) / (2 * h * h);
    return out;
}
Vector velocity_of(const Vector& x, double h) {
    Vector out = Vector::Zero(x.size());
    for (Index k = 0; k + 1 < x.size(); ++k)
        out[k] = (x[k + 1] - x[k]) / h;
    return out;
}

// The motor's acceleration seen through a known elastic load: the torque for J = 1.
Vector through_modes(const Modes& m, const Vector& acceleration, double h) {
    constexpr int parts = 16;
    const double a = m.antiresonance, r = m.resonance, step = h / parts;
    double p = 0, rate = 0;
    Vector out(acceleration.size());
    for (Index k = 0; k < acceleration.size(); ++k) {
        double sum = 0;
        for (int i = 0; i < parts; ++i) {
            p += rate * step / 2;
            const double bend =
                acceleration[k] - 2 * m.antiresonance_damping * a * rate - a * a * p;
            rate += bend * step;
            p += rate * step / 2;
            sum += bend + 2 * m.resonance_damping * r * rate + r * r * p;
        }
        out[k] = a * a / (r * r) * sum / parts;
    }
    return out;
}

double rms(const Vector& x) {
    return x.size() ? std::sqrt(x.squaredNorm() / static_cast<double>(x.size())) : 0;
}

} // namespace

Strength measure(const World& world, const World& without, const servoid::Model& known,
                 const Record& record, double band_Hz) {
    const double h = world.period;
    const Vector asked = as_vector(record.asked), noise = as_vector(record.noise);
    const Vector speed = as_vector(record.mean_velocity);
    const Vector direction = as_vector(record.direction), x = as_vector(record.position);
    Vector acceleration = as_vector(record.acceleration);
    if (without.modes) acceleration = through_modes(*without.modes, acceleration, h);

    // What the encoder's own error adds to the motion as the tool sees it, and the counts.
    Vector seen = x;
    for (Index k = 0; k < x.size(); ++k)
        seen[k] += world.eccentricity * std::sin(x[k] + world.eccentricity_phase);
    const Vector wrong = seen - x, counted = as_vector(record.measured) - seen;
    const double j = without.inertia, d = without.viscous_forward;
    const Vector needed = j * acceleration + d * speed + without.coulomb_forward * direction +
                          Vector::Constant(x.size(), without.constant);
    const Vector hidden =
        asked + noise - needed - j * acceleration_of(wrong, h) - d * velocity_of(wrong, h);
    const Vector floor = noise + j * acceleration_of(counted, h);

    const Smoother smooth(h, band_Hz);
    std::vector<Vector> columns = {smooth(acceleration)};
    if (known.find("viscous")) columns.push_back(smooth(speed));
    if (known.find("coulomb")) columns.push_back(smooth(direction));
    if (known.find("constant_torque")) columns.push_back(smooth(Vector::Ones(x.size())));
    const Vector rest = smooth(as_vector(record.stuck));
    std::vector<Index> rows;
    for (Index k = 0; k < rest.size(); ++k)
        if (rest[k] < 0.05) rows.push_back(k);
    if (rows.size() < 30) return {};

    Eigen::MatrixXd a(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
    for (Index c = 0; c < a.cols(); ++c) {
        const Vector picked = columns[static_cast<size_t>(c)](rows);
        a.col(c) = picked / std::max(1e-300, picked.norm());
    }
    const Vector target = smooth(hidden)(rows);
    const Vector left = target - a * a.colPivHouseholderQr().solve(target);
    Strength out;
    out.torque_rms = rms(smooth(asked)(rows));
    out.share = rms(left) / out.torque_rms;
    out.floor = rms(smooth(floor)(rows)) / out.torque_rms;
    return out;
}

} // namespace blind
