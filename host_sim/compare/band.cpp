// The choice of the band in which torque and motion are compared.
#include "common/error.hpp"
#include "compare/motion.hpp"
#include "compare/noise.hpp"
#include "compare/spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kPowerShare = 0.998; // of the torque lies below half the band
constexpr double kExcited = 0.995;    // of the power of the reference's acceleration
constexpr double kHarmonics = 4;      // of what is excited: what friction makes of it
constexpr double kThird = 1.26;       // third octaves
constexpr double kWorthBand = 0.005;  // of the torque in a third of an octave
constexpr double kAboveNoise = 10;    // in power, what repeats over what does not
constexpr double kNoiseShare = 0.03;  // of the torque may be noise of the acceleration: the inertia
                                      // is then low by at most the square of it, 0.1 %
constexpr double kHighest = 0.11;     // of the sample rate: room for the smoothing of the motion

// Frequency below which `share` of the power of the signal (without its mean) lies.
double edge_of_power(const Vector& signal, double sample_time_s, double share) {
    const Spectrum spectrum = power_spectrum(signal, sample_time_s);
    const double total = spectrum.power.sum();
    double sum = 0;
    for (Eigen::Index k = 0; k < spectrum.power.size(); ++k) {
        sum += spectrum.power[k];
        if (sum >= share * total) return double(k) * spectrum.step_Hz;
    }
    return double(spectrum.power.size() - 1) * spectrum.step_Hz;
}

// Above the excitation and its first harmonics torque and motion are noise that the loop has fed
// round: no band for a model. Infinite where the reference was not recorded.
double excited_band(const Capture& capture) {
    if (capture.position_ref.size() < 8 || !capture.uniform) return INFINITY;
    const Eigen::Map<const Vector> r(capture.position_ref.data(), Eigen::Index(capture.rows()));
    const Eigen::Index n = r.size() - 2;
    const Vector acceleration = r.tail(n) - 2 * r.segment(1, n) + r.head(n);
    if (!(acceleration.squaredNorm() > 0)) return INFINITY;
    return kHarmonics * edge_of_power(acceleration, capture.sample_time_s, kExcited);
}

// The torque at x and one period later, at x + lag (in samples): their half sum and half
// difference.
struct Folded {
    Vector sum, difference;
};
Folded fold(const Vector& torque, double lag) {
    const auto whole = Eigen::Index(std::floor(lag));
    const double part = lag - double(whole);
    const Eigen::Index n = torque.size() - whole - 1;
    const Vector later =
        (1 - part) * torque.segment(whole, n) + part * torque.segment(whole + 1, n);
    return {(torque.head(n) + later) / 2, (torque.head(n) - later) / 2};
}

// How far up torque comes back with every period, well above what does not: cogging at full speed
// and the edge of a reversal lie far above a slow sine. 0 where nothing does.
double repeating_band(const Capture& capture, const Vector& torque, double period_s) {
    const Folded folded = fold(torque, period_s / capture.sample_time_s);
    if (folded.sum.size() < 64) return 0;
    const Spectrum both = power_spectrum(folded.sum, capture.sample_time_s);
    const Spectrum noise = power_spectrum(folded.difference, capture.sample_time_s);
    const double worth = std::pow(kWorthBand * rms(torque), 2);
    double highest = 0;
    for (double from = 4 * both.step_Hz; from < kHighest / capture.sample_time_s; from *= kThird) {
        const auto first = Eigen::Index(std::ceil(from / both.step_Hz));
        const auto count = Eigen::Index(std::ceil(from * kThird / both.step_Hz)) - first;
        const Eigen::Index fits = std::min(count, both.power.size() - first);
        if (fits <= 0) break;
        const double sum = both.power.segment(first, fits).sum();
        const double difference = noise.power.segment(first, fits).sum();
        if (sum - difference > std::max(worth, kAboveNoise * difference)) highest = from * kThird;
    }
    return highest;
}

// Noise of the acceleration against the acceleration itself in a band: as torque, what the
// inertia makes of it.
double noise_share(const Capture& capture, const Vector& source, double noise, double band_Hz) {
    const LowPass low_pass(capture.sample_time_s, band_Hz);
    const double margin = low_pass.half_length_s();
    const double last = double(source.size() - 1) * capture.sample_time_s - margin;
    const double step = std::max(capture.sample_time_s, 1 / (4 * band_Hz));
    if (last <= margin) return 1;
    const Grid grid{margin, step, Eigen::Index((last - margin) / step)};
    const int order = capture.has_position() ? 2 : 1;
    const double acceleration = rms(low_pass.apply(source, grid, order));
    return acceleration > 0 ? noise * low_pass.noise_gain(order) / acceleration : 1;
}

} // namespace

Band choose_band(const Capture& capture, Input input, std::optional<double> period_s) {
    const std::vector<double>& torque = *choose_torque(capture, input).values;
    const std::vector<double>& motion =
        capture.has_position() ? capture.position : capture.velocity;
    const Eigen::Map<const Vector> t(torque.data(), Eigen::Index(torque.size()));
    const Vector m = Eigen::Map<const Vector>(motion.data(), Eigen::Index(motion.size()));
    const double quantum =
        capture.has_position() ? capture.position_quantum : capture.velocity_quantum;
    const double noise = sample_noise(m, quantum);
    const double length_s = double(capture.rows()) * capture.sample_time_s;
    const double lowest = std::min(24 / length_s, kHighest / capture.sample_time_s);
    const double highest = kHighest / capture.sample_time_s;
    const double of_torque = 2 * edge_of_power(t, capture.sample_time_s, kPowerShare);
    const double excited = excited_band(capture);
    const double repeating = period_s ? repeating_band(capture, t, *period_s) : 0;
    const double known = std::max(excited, repeating);
    const double widest = std::min(of_torque, known);
    double band = std::clamp(widest, lowest, highest);
    BandLimit limit = known < of_torque ? BandLimit::excitation : BandLimit::torque;
    if (limit == BandLimit::excitation && repeating > excited) limit = BandLimit::repetition;
    if (widest > highest) limit = BandLimit::sample_rate;
    if (widest < lowest) limit = BandLimit::record;
    while (band > 1.2 * lowest && noise_share(capture, m, noise, band) > kNoiseShare)
        band /= 1.2, limit = BandLimit::noise;
    // Two significant digits: a band is stated and repeated by people.
    const double unit = std::pow(10, std::floor(std::log10(band)) - 1);
    return {std::max(unit, std::floor(band / unit) * unit), limit};
}

} // namespace servoid
