#include "compare/spectrum.hpp"
#include "story/transfer.hpp"
#include "story/views.hpp"

#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr Eigen::Index kMostLines = 600;
constexpr size_t kOrderPoints = 20000; // enough for an amplitude, few enough to be quick
constexpr int kMostOrders = 4000;

// Amplitude of a sine with the power of a few neighbouring bins.
std::vector<double> amplitudes(const Spectrum& s, Eigen::Index bins, Eigen::Index used) {
    std::vector<double> out;
    for (Eigen::Index k = 0; k < used; k += bins)
        out.push_back(std::sqrt(2 * s.power.segment(k, std::min(bins, used - k)).sum()));
    return out;
}

// Sums over points at equally spaced orders: each is the last one turned a little further.
struct Orders {
    double first = 0, step = 0; // rad per unit of position
    int count = 0;
};

std::vector<double> amplitudes(const std::vector<Point>& points, const Orders& orders) {
    using Complex = std::complex<double>;
    std::vector<Complex> wave, turn;
    for (const auto& [place, value] : points) {
        wave.push_back(std::polar(1.0, orders.first * place));
        turn.push_back(std::polar(1.0, orders.step * place));
    }
    std::vector<double> out;
    for (int k = 0; k < orders.count; ++k) {
        Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
        Eigen::Vector3d moment = Eigen::Vector3d::Zero();
        for (size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d x(wave[i].real(), wave[i].imag(), 1);
            gram.noalias() += x * x.transpose();
            moment += points[i].second * x;
            wave[i] *= turn[i];
        }
        const Eigen::Vector3d fitted = gram.inverse() * moment;
        out.push_back(std::hypot(fitted[0], fitted[1]));
    }
    return out;
}

std::vector<Point> every_nth(const std::vector<Point>& points, size_t most) {
    const size_t every = points.size() / most + 1;
    std::vector<Point> out;
    for (size_t i = 0; i < points.size(); i += every)
        out.push_back(points[i]);
    return out;
}

struct Ratio {
    std::vector<double> gain, phase_deg;
    void take(std::complex<double> response) {
        gain.push_back(std::abs(response));
        double phase = std::arg(response) * 180 / std::numbers::pi;
        if (!phase_deg.empty()) phase -= 360 * std::round((phase - phase_deg.back()) / 360);
        phase_deg.push_back(phase);
    }
};

} // namespace

Json spectrum_json(const Scene& scene, double noise_floor) {
    const SceneCapture& c = scene.longest();
    const PreparedMotion& m = c.motion;
    const Spectrum torque = power_spectrum(c.delivered, m.grid.step_s);
    const Spectrum residual = power_spectrum(c.residual(), m.grid.step_s);
    const Eigen::Index used = std::clamp<Eigen::Index>(Eigen::Index(m.band_Hz / torque.step_Hz) + 1,
                                                       1, torque.power.size());
    const Eigen::Index bins = (used + kMostLines - 1) / kMostLines;
    std::vector<double> frequency, floor;
    // As if it were white up to the band's edge.
    const double per_bin =
        noise_floor * noise_floor * torque.power.sum() * torque.step_Hz / m.band_Hz;
    for (Eigen::Index k = 0; k < used; k += bins) {
        frequency.push_back((double(k) + 0.5 * double(bins - 1)) * torque.step_Hz);
        floor.push_back(std::sqrt(2 * per_bin * double(bins)));
    }
    return {{"frequency_Hz", numbers(frequency)},
            {"torque", numbers(amplitudes(torque, bins, used))},
            {"residual", numbers(amplitudes(residual, bins, used))},
            {"floor", numbers(floor)}};
}

Json orders_json(const Scene& scene) {
    const std::vector<Eigen::VectorXd> residuals = residuals_of(scene);
    const std::vector<Point> points =
        every_nth(points_against(Against::position, scene, residuals), kOrderPoints);
    if (points.size() < 100) return nullptr;
    const auto [low, high] = std::minmax_element(points.begin(), points.end());
    const double travel = high->first - low->first;
    if (!(travel > 0)) return nullptr;
    double highest = 0; // what the speed lets through the band
    for (const SceneCapture& c : scene.captures)
        highest =
            std::max(highest, 0.5 * c.motion.band_Hz / c.motion.velocity.cwiseAbs().maxCoeff());
    // From two cycles in the travel on, five steps a cycle.
    const double step = 0.2 / travel;
    const int count = std::min(kMostOrders, int(highest / step)) - 10;
    if (count < 10) return nullptr;
    const double turn = 2 * std::numbers::pi;
    const std::vector<double> amplitude =
        amplitudes(points, {10 * step * turn, step * turn, count});
    const double per = scene.model.motion == Motion::rotary ? turn : 1;
    std::vector<double> order;
    for (int i = 0; i < count; ++i)
        order.push_back((i + 10) * step * per);
    return {{"unit", per > 1 ? "per rev" : "per m"},
            {"order", numbers(order)},
            {"residual", numbers(amplitude)}};
}

Json response_json(const Scene& scene) {
    const SceneCapture& c = scene.longest();
    const PreparedMotion& m = c.motion;
    const Segments segments{m.period_s, m.band_Hz};
    const auto measured = transfer(c.delivered, m.acceleration, m.grid.step_s, segments);
    const auto modelled = transfer(c.model_torque, m.acceleration, m.grid.step_s, segments);
    Ratio measured_ratio, model_ratio;
    std::vector<double> frequency, bias, std, coherence;
    for (const TransferLine& line : measured) {
        const auto same = std::find_if(modelled.begin(), modelled.end(), [&](const auto& other) {
            return other.frequency_Hz == line.frequency_Hz;
        });
        if (same == modelled.end() || line.coherence < 0.5) continue;
        frequency.push_back(line.frequency_Hz);
        measured_ratio.take(line.response), model_ratio.take(same->response);
        bias.push_back(100 * (std::abs(line.response) / std::abs(same->response) - 1));
        std.push_back(100 * line.relative_std);
        coherence.push_back(line.coherence);
    }
    if (frequency.size() < 3) return nullptr;
    return {{"frequency_Hz", numbers(frequency)},
            {"measured_gain", numbers(measured_ratio.gain)},
            {"measured_phase_deg", numbers(measured_ratio.phase_deg)},
            {"model_gain", numbers(model_ratio.gain)},
            {"model_phase_deg", numbers(model_ratio.phase_deg)},
            {"bias_percent", numbers(bias)},
            {"bias_std_percent", numbers(std)},
            {"coherence", numbers(coherence)}};
}

} // namespace servoid
