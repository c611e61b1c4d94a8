// Finding the stretches of constant speed in a capture.
#include "compare/low_pass.hpp"
#include "compare/noise.hpp"
#include "identify/friction.hpp"

#include "common/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kWithin = 0.03; // of the median speed
constexpr double kPlateauBlock_s = 0.02;
constexpr long kFewest = 16; // samples of a run

struct Speed {
    Vector velocity; // per row; rows near the ends of a record without velocity are NaN
    double noise = 0;
};

Speed speed_of(const Capture& capture) {
    Speed out;
    if (!capture.velocity.empty()) {
        out.velocity =
            Eigen::Map<const Vector>(capture.velocity.data(), Eigen::Index(capture.rows()));
        out.noise = sample_noise(out.velocity, capture.velocity_quantum);
        return out;
    }
    const double step = capture.sample_time_s;
    const double length = double(capture.rows()) * step;
    const LowPass low_pass(step, std::min(0.11 / step, std::max(30.0, 60 / length)));
    const Vector p =
        Eigen::Map<const Vector>(capture.position.data(), Eigen::Index(capture.rows()));
    out.velocity = low_pass.apply(p, {0, step, p.size()}, 1);
    const auto margin =
        std::min(p.size() / 2, Eigen::Index(std::ceil(low_pass.half_length_s() / step)));
    out.velocity.head(margin).setConstant(NAN);
    out.velocity.tail(margin).setConstant(NAN);
    out.noise = sample_noise(p, capture.position_quantum) * low_pass.noise_gain(1);
    return out;
}

double median_of(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (values.empty()) return NAN;
    const auto middle = values.begin() + long(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Stretch {
    long first = 0, end = 0;
    int segment = -1;
};

std::vector<Stretch> by_segment(const Capture& capture) {
    std::vector<Stretch> out;
    for (long i = 0; i < long(capture.rows()); ++i) {
        const int label = capture.segment[size_t(i)];
        if (out.empty() || out.back().segment != label) out.push_back({i, i, label});
        out.back().end = i + 1;
    }
    return out;
}

double tolerance(const Capture& capture, const Speed& speed, double median) {
    return std::max({kWithin * std::abs(median), 2.01 * capture.velocity_quantum, 5 * speed.noise});
}

// The mean speed around each row: single rows may stray further than the speed itself does.
Vector smoothed(const Vector& velocity, const Stretch& s) {
    const long half = kFewest / 2;
    Vector out(s.end - s.first);
    for (long i = s.first; i < s.end; ++i) {
        const long from = std::max(s.first, i - half), to = std::min(s.end, i + half + 1);
        out[i - s.first] = velocity.segment(from, to - from).mean();
    }
    return out;
}

// The longest part of a stretch that stays near the stretch's median speed, less its first half:
// the loop is still settling there.
Stretch steady_part(const Capture& capture, const Speed& speed, const Stretch& s) {
    const double median =
        median_of({speed.velocity.data() + s.first, speed.velocity.data() + s.end});
    const double within = tolerance(capture, speed, median);
    const Vector mean = smoothed(speed.velocity, s);
    Stretch best{s.first, s.first, s.segment};
    for (long i = s.first; i < s.end;) {
        long end = i;
        while (end < s.end && std::abs(mean[end - s.first] - median) <= within)
            ++end;
        if (end - i > best.end - best.first) best = {i, end, s.segment};
        i = std::max(end, i + 1);
    }
    const bool settles = best.first > s.first && best.end - best.first > 4 * kFewest;
    if (settles) best.first += (best.end - best.first) / 2;
    return best;
}

// A capture without segments: neighbouring blocks of the same speed make a stretch.
std::vector<Stretch> plateaus(const Capture& capture, const Speed& speed) {
    const long block = std::max(kFewest / 2, std::lround(kPlateauBlock_s / capture.sample_time_s));
    std::vector<Stretch> out;
    double last = NAN;
    for (long i = 0; i + block <= long(capture.rows()); i += block) {
        const Vector part = speed.velocity.segment(i, block);
        const double mean = part.mean(), within = tolerance(capture, speed, mean);
        const bool steady = std::isfinite(mean) && part.maxCoeff() - part.minCoeff() <= 2 * within;
        if (steady && std::abs(mean - last) <= within)
            out.back().end = i + block;
        else if (steady)
            out.push_back({i, i + block, -1});
        last = steady ? mean : NAN;
    }
    std::erase_if(out, [&](const Stretch& s) { return s.end - s.first < 3 * block; });
    return out;
}

bool mostly_steady(const Capture& capture, const Speed& speed) {
    const double median = median_of({speed.velocity.begin(), speed.velocity.end()});
    const double within = tolerance(capture, speed, median);
    const auto near = std::count_if(speed.velocity.begin(), speed.velocity.end(),
                                    [&](double v) { return std::abs(v - median) <= within; });
    return double(near) > 0.6 * double(speed.velocity.size());
}

SpeedRun measure(const Capture& capture, const Speed& speed, const std::vector<double>& torque,
                 const Stretch& s) {
    SpeedRun run;
    run.file = capture.path, run.segment = s.segment, run.samples = s.end - s.first;
    const auto n = double(run.samples);
    double sum_v = 0, sum_t = 0, sum_tt = 0;
    for (long i = s.first; i < s.end; ++i) {
        const double t = torque[size_t(i)];
        sum_v += speed.velocity[i], sum_t += t, sum_tt += t * t;
    }
    run.velocity = sum_v / n, run.torque = sum_t / n;
    run.torque_spread = std::sqrt(std::max(0.0, sum_tt / n - run.torque * run.torque));
    return run;
}

} // namespace

std::vector<SpeedRun> find_runs(const Capture& capture, Input input) {
    const std::vector<double>& torque = *choose_torque(capture, input).values;
    const Speed speed = speed_of(capture);
    std::vector<Stretch> stretches;
    if (!capture.segment.empty())
        for (const Stretch& s : by_segment(capture))
            stretches.push_back(steady_part(capture, speed, s));
    else if (mostly_steady(capture, speed))
        stretches.push_back(steady_part(capture, speed, {0, long(capture.rows()), -1}));
    else
        stretches = plateaus(capture, speed);
    std::vector<SpeedRun> out;
    for (const Stretch& s : stretches) {
        if (s.end - s.first < kFewest) continue;
        const SpeedRun run = measure(capture, speed, torque, s);
        const double still = std::max(4 * speed.noise, 0.5 * capture.velocity_quantum);
        if (std::abs(run.velocity) > still) out.push_back(run);
    }
    if (out.empty())
        throw Refusal(capture.path + ": no stretch of constant speed is in it",
                      "runs of at least 0.2 s at constant speed, several speeds, both directions");
    return out;
}

} // namespace servoid
