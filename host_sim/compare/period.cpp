#include "compare/period.hpp"

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

// Mismatch ‖x(t+lag) − x(t)‖² / (2‖x‖²) for every lag up to half the record, from one
// autocorrelation: 0 where the signal repeats, about 1 where it does not.
std::vector<double> mismatch(const Vector& x) {
    const auto n = static_cast<size_t>(x.size());
    size_t length = 1;
    while (length < 2 * n)
        length *= 2;
    std::vector<double> padded(length, 0.0);
    for (size_t i = 0; i < n; ++i)
        padded[i] = x[Eigen::Index(i)];
    std::vector<std::complex<double>> lines;
    Eigen::FFT<double> fft;
    fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    fft.fwd(lines, padded);
    for (auto& line : lines)
        line = std::norm(line);
    std::vector<double> correlation;
    fft.inv(correlation, lines, Eigen::Index(length));
    std::vector<double> head(n + 1, 0.0); // head[i]: energy of the first i samples
    for (size_t i = 0; i < n; ++i)
        head[i + 1] = head[i] + padded[i] * padded[i];
    std::vector<double> out(n / 2 + 1, 1.0);
    for (size_t lag = 1; lag < out.size(); ++lag) {
        const double both = head[n - lag] + (head[n] - head[lag]);
        out[lag] = both > 0 ? (both - 2 * correlation[lag]) / both : 1;
    }
    return out;
}

// A straight line through the record is no period: a table that moves on by a turn each time.
Vector without_mean(const std::vector<double>& values) {
    Vector x = Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
    x.array() -= x.mean();
    return x;
}

// The first deep minimum after the correlation has once been lost, refined between samples.
double first_return(const std::vector<double>& miss, double deep) {
    size_t lag = 1;
    while (lag < miss.size() && miss[lag] < 0.3)
        ++lag;
    for (; lag + 1 < miss.size(); ++lag) {
        if (miss[lag] > deep || miss[lag] > miss[lag - 1] || miss[lag] > miss[lag + 1]) continue;
        const double a = miss[lag - 1], b = miss[lag], c = miss[lag + 1];
        const double bend = a - 2 * b + c;
        return double(lag) + (bend > 0 ? 0.5 * (a - c) / bend : 0);
    }
    return 0;
}

} // namespace

std::optional<double> find_period(const Capture& capture) {
    const double length_s = double(capture.rows()) * capture.sample_time_s;
    if (capture.period_s)
        return *capture.period_s <= length_s / 2 ? capture.period_s : std::nullopt;
    if (!capture.uniform || capture.rows() < 64) return std::nullopt;
    const bool has_reference = !capture.position_ref.empty();
    const std::vector<double>& signal = has_reference            ? capture.position_ref
                                        : capture.has_position() ? capture.position
                                                                 : capture.velocity;
    const Vector x = without_mean(signal);
    if (!(x.squaredNorm() > 0)) return std::nullopt;
    const double lag = first_return(mismatch(x), has_reference ? 1e-3 : 1e-2);
    if (lag <= 0) return std::nullopt;
    return lag * capture.sample_time_s;
}

} // namespace servoid
