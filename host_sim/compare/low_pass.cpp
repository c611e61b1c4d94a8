#include "compare/low_pass.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace servoid {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPhases = 64; // tap sets per sample; between them straight lines, within 2e-5

// sin(x)/x and its first two derivatives.
double sinc(double x, int derivative) {
    if (std::abs(x) < 1e-2) { // series to x^6: below 1e-17 here
        const double x2 = x * x;
        if (derivative == 0) return 1 - x2 / 6 * (1 - x2 / 20 * (1 - x2 / 42));
        if (derivative == 1) return -x / 3 * (1 - x2 / 10 * (1 - x2 / 28));
        return -1.0 / 3 * (1 - 3 * x2 / 10 * (1 - 5 * x2 / 84));
    }
    const double s = std::sin(x) / x, c = std::cos(x);
    if (derivative == 0) return s;
    if (derivative == 1) return (c - s) / x;
    return -s - 2 * (c - s) / (x * x);
}

// Blackman window on −1 … 1 and its derivatives.
double window(double u, int derivative) {
    const double a = kPi * u, b = 2 * kPi * u;
    if (derivative == 0) return 0.42 + 0.5 * std::cos(a) + 0.08 * std::cos(b);
    if (derivative == 1) return -kPi * (0.5 * std::sin(a) + 0.16 * std::sin(b));
    return -kPi * kPi * (0.5 * std::cos(a) + 0.32 * std::cos(b));
}

} // namespace

struct LowPass::Cache {
    std::mutex mutex;
    std::map<std::pair<int, int>, Taps> taps;
};

LowPass::LowPass(double sample_time_s, double band_Hz)
    : sample_time_s_(sample_time_s), band_Hz_(band_Hz), half_length_s_(3.1 / band_Hz),
      reach_(long(std::ceil(half_length_s_ / sample_time_s))), cache_(std::make_shared<Cache>()) {
    if (!(sample_time_s > 0) || !(band_Hz > 0))
        throw std::invalid_argument("low pass: sample time and band must be positive");
}

double LowPass::kernel(double t_s, int derivative) const {
    const double u = t_s / half_length_s_;
    if (std::abs(u) >= 1) return 0;
    const double w = 2 * kPi * band_Hz_, x = w * t_s, l = half_length_s_;
    const double scale = 2 * band_Hz_;
    const double s0 = sinc(x, 0), w0 = window(u, 0);
    if (derivative == 0) return scale * s0 * w0;
    const double s1 = w * sinc(x, 1), w1 = window(u, 1) / l;
    if (derivative == 1) return scale * (s1 * w0 + s0 * w1);
    const double s2 = w * w * sinc(x, 2), w2 = window(u, 2) / (l * l);
    return scale * (s2 * w0 + 2 * s1 * w1 + s0 * w2);
}

// Scaled so that a constant, a slope and a parabola come out exactly: the moments that should be
// zero are (the kernel's tails, sampled off its centre, leave a little), the last one is one.
LowPass::Taps LowPass::taps(double phase, int derivative) const {
    const long n = 2 * reach_ + 1;
    Eigen::VectorXd taps(n), t(n);
    for (long i = 0; i < n; ++i) {
        t[i] = (phase + double(reach_ - i)) * sample_time_s_; // instant minus sample
        taps[i] = kernel(t[i], derivative) * sample_time_s_;
    }
    if (derivative > 0) taps.array() -= taps.mean();
    if (derivative > 1) {
        const Eigen::VectorXd centred = t.array() - t.mean();
        taps -= taps.dot(centred) / centred.squaredNorm() * centred;
    }
    const Eigen::VectorXd power = derivative == 0   ? Eigen::VectorXd::Ones(n)
                                  : derivative == 1 ? Eigen::VectorXd(-t)
                                                    : Eigen::VectorXd(t.cwiseProduct(t) / 2);
    taps /= taps.dot(power);
    return Taps(taps.begin(), taps.end());
}

// References into a map stay valid while others are added.
const LowPass::Taps& LowPass::cached_taps(int phase, int derivative) const {
    const std::lock_guard lock(cache_->mutex);
    auto found = cache_->taps.find({phase, derivative});
    if (found == cache_->taps.end())
        found =
            cache_->taps
                .emplace(std::pair{phase, derivative}, taps(double(phase) / kPhases, derivative))
                .first;
    return found->second;
}

Eigen::VectorXd LowPass::apply(const Eigen::VectorXd& x, const Grid& grid, int derivative,
                               double shift_s) const {
    Eigen::VectorXd out(grid.count);
    // The cache's lock is dear beside one sum: each set of taps is asked for once.
    std::vector<const Taps*> known(size_t(kPhases) + 1, nullptr);
    const auto taps_of = [&](int which) -> const Taps& {
        const Taps*& place = known[size_t(which)];
        if (!place) place = &cached_taps(which, derivative);
        return *place;
    };
    for (Eigen::Index k = 0; k < grid.count; ++k) {
        const double place = (grid.at(k) - shift_s) / sample_time_s_;
        const double whole = std::floor(place + 1e-9);
        const double fine = std::max(0.0, (place - whole) * kPhases);
        const int phase = std::min(int(fine), kPhases - 1);
        const double share = fine - phase; // of the next tap set
        const long first = long(whole) - reach_;
        const auto sum = [&](int which) {
            const Taps& taps = taps_of(which);
            const long lost = std::max(0L, -first);
            const long n = std::min(long(taps.size()), long(x.size()) - first);
            if (n <= lost) return 0.0;
            return Eigen::Map<const Eigen::VectorXd>(taps.data() + lost, n - lost)
                .dot(x.segment(first + lost, n - lost));
        };
        // A delay that is searched for must move the result however little it moves itself.
        out[k] = share < 1e-7 ? sum(phase) : (1 - share) * sum(phase) + share * sum(phase + 1);
    }
    return out;
}

double LowPass::noise_gain(int derivative) const {
    double sum = 0;
    for (double tap : taps(0, derivative))
        sum += tap * tap;
    return std::sqrt(sum);
}

} // namespace servoid
