#include "story/transfer.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;
using Lines = std::vector<std::complex<double>>;

constexpr double kPowerless = 1e-4; // of the strongest line of x
constexpr int kSegments = 8;        // of a record that does not repeat, half overlapping

// Where the segments lie, in instants.
struct Cut {
    Eigen::Index length = 0;
    double hop = 0;
    int count = 0;
    bool hann = false;
    double independent = 0;
    Eigen::Index start(int segment) const { return Eigen::Index(std::lround(segment * hop)); }
};

Cut cut_of(Eigen::Index size, double step_s, const Segments& segments) {
    if (segments.period_s) {
        const double period = *segments.period_s / step_s;
        const int whole = int((double(size) + 0.5) / period);
        if (whole >= 2)
            return {Eigen::Index(std::lround(period)), period, whole, false, double(whole)};
    }
    const Eigen::Index length = 2 * (size / (kSegments + 1));
    if (length < 16) return {};
    // Half overlapping Hann segments are worth 11/18 … 0.95 of as many independent ones.
    return {length, 0.5 * double(length), kSegments, true, 0.9 * kSegments};
}

Lines lines_of(Eigen::FFT<double>& fft, const Vector& x, const Cut& cut, int segment) {
    const Eigen::Index start = std::min(cut.start(segment), x.size() - cut.length);
    const Vector part = x.segment(start, cut.length);
    const double mean = part.mean();
    std::vector<double> windowed(size_t(cut.length));
    for (Eigen::Index i = 0; i < cut.length; ++i) {
        const double turn = 2 * std::numbers::pi * (double(i) + 0.5) / double(cut.length);
        windowed[size_t(i)] = (part[i] - mean) * (cut.hann ? 0.5 - 0.5 * std::cos(turn) : 1);
    }
    Lines out;
    fft.fwd(out, windowed);
    return out;
}

struct Spectra {
    std::vector<double> xx, yy;
    Lines yx;
};

Spectra spectra_of(const Vector& x, const Vector& y, const Cut& cut) {
    Eigen::FFT<double> fft;
    const auto half = size_t(cut.length / 2);
    Spectra s{std::vector<double>(half), std::vector<double>(half), Lines(half)};
    for (int i = 0; i < cut.count; ++i) {
        const Lines fx = lines_of(fft, x, cut, i), fy = lines_of(fft, y, cut, i);
        for (size_t k = 0; k < half; ++k) {
            s.xx[k] += std::norm(fx[k]), s.yy[k] += std::norm(fy[k]);
            s.yx[k] += fy[k] * std::conj(fx[k]);
        }
    }
    return s;
}

} // namespace

std::vector<TransferLine> transfer(const Vector& x, const Vector& y, double step_s,
                                   const Segments& segments) {
    const Cut cut = cut_of(x.size(), step_s, segments);
    if (cut.count < 2) return {};
    const Spectra s = spectra_of(x, y, cut);
    const double strongest = *std::max_element(s.xx.begin(), s.xx.end());
    std::vector<TransferLine> out;
    for (size_t k = 1; k < s.xx.size(); ++k) {
        const double frequency = double(k) / (double(cut.length) * step_s);
        if (frequency > segments.highest_Hz) break;
        if (!(s.xx[k] > kPowerless * strongest)) continue;
        TransferLine line{frequency, s.yx[k] / s.xx[k], 0, 0};
        const double yy = s.yy[k] > 0 ? s.yy[k] : 1e-300;
        line.coherence = std::min(1.0, std::norm(s.yx[k]) / (s.xx[k] * yy));
        line.relative_std = std::sqrt((1 - line.coherence) /
                                      (2 * cut.independent * std::max(1e-12, line.coherence)));
        out.push_back(line);
    }
    return out;
}

} // namespace servoid
