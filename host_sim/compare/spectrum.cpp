#include "compare/spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace servoid {

namespace {

// The next length ≥ n that is 2^a·3^b·5^c: any other makes the transform slow.
size_t smooth_length(size_t n) {
    for (;; ++n) {
        size_t rest = n;
        for (size_t factor : {2, 3, 5})
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1) return n;
    }
}

} // namespace

Spectrum power_spectrum(const Eigen::VectorXd& signal, double sample_time_s) {
    const auto n = static_cast<size_t>(signal.size());
    const size_t length = smooth_length(n + n % 2);
    std::vector<double> padded(length + length % 2, 0.0);
    const double mean = signal.mean();
    double weight = 0;
    for (size_t i = 0; i < n; ++i) {
        const double w = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (double(i) + 0.5) / double(n));
        padded[i] = w * (signal[Eigen::Index(i)] - mean);
        weight += w * w;
    }
    std::vector<std::complex<double>> lines;
    Eigen::FFT<double> fft;
    fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    fft.fwd(lines, padded);
    Spectrum out;
    out.step_Hz = 1 / (double(padded.size()) * sample_time_s);
    out.power.resize(Eigen::Index(lines.size()));
    for (size_t k = 0; k < lines.size(); ++k)
        out.power[Eigen::Index(k)] =
            (k == 0 ? 1 : 2) * std::norm(lines[k]) / (weight * double(padded.size()));
    return out;
}

namespace {

// Parabola through the logarithms of three bins: exact for a Gaussian-like main lobe.
double between_bins(const Spectrum& spectrum, Eigen::Index k) {
    if (k == 0 || k + 1 >= spectrum.power.size()) return double(k) * spectrum.step_Hz;
    const double a = std::log(spectrum.power[k - 1] + 1e-300);
    const double b = std::log(spectrum.power[k] + 1e-300);
    const double c = std::log(spectrum.power[k + 1] + 1e-300);
    const double bend = a - 2 * b + c;
    return (double(k) + (bend < 0 ? 0.5 * (a - c) / bend : 0)) * spectrum.step_Hz;
}

} // namespace

std::vector<double> strongest_lines_Hz(const Eigen::VectorXd& signal, double sample_time_s,
                                       int most) {
    const Spectrum spectrum = power_spectrum(signal, sample_time_s);
    const auto& p = spectrum.power;
    std::vector<Eigen::Index> peaks;
    for (Eigen::Index k = 1; k + 1 < p.size(); ++k)
        if (p[k] > p[k - 1] && p[k] >= p[k + 1] && p[k] > 0) peaks.push_back(k);
    std::sort(peaks.begin(), peaks.end(),
              [&](Eigen::Index a, Eigen::Index b) { return p[a] > p[b]; });
    std::vector<double> out;
    for (size_t i = 0; i < peaks.size() && i < size_t(most); ++i)
        out.push_back(between_bins(spectrum, peaks[i]));
    return out;
}

double strongest_line_Hz(const Eigen::VectorXd& signal, double sample_time_s) {
    const Spectrum spectrum = power_spectrum(signal, sample_time_s);
    Eigen::Index k = 0;
    if (!(spectrum.power.maxCoeff(&k) > 0)) return 0;
    return between_bins(spectrum, k);
}

double effective_count(const Eigen::VectorXd& residual) {
    const Spectrum spectrum = power_spectrum(residual, 1);
    const double total = spectrum.power.sum(), square = spectrum.power.squaredNorm();
    if (!(square > 0)) return 1;
    // White noise: N/2 bins whose powers scatter like an exponential, so that Σ²/Σ(²) is N/4.
    const double count = 4 * total * total / square;
    return std::clamp(count, 4.0, double(residual.size()));
}

} // namespace servoid
