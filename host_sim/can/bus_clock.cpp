#include "can/bus_clock.hpp"

#include "common/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace servoid::can {

namespace {

constexpr std::size_t kFewest = 8;
constexpr std::size_t kAhead = 6; // arrivals that must agree on a lost or a repeated frame
constexpr std::size_t kFirst = 16;
constexpr double kFollow = 0.02; // of a delay that the start follows: drift of either clock

double median_step(const std::vector<double>& arrivals) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < arrivals.size(); ++i)
        steps.push_back(arrivals[i] - arrivals[i - 1]);
    const auto middle = steps.begin() + long(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

// The least delay of arrival i and the next few, were none of them lost or repeated.
double lasting_delay(const std::vector<double>& arrivals, std::size_t i, double expected_s,
                     double period_s) {
    double least = INFINITY;
    const std::size_t end = std::min(arrivals.size(), i + kAhead);
    for (std::size_t j = i; j < end; ++j)
        least = std::min(least, arrivals[j] - expected_s - double(j - i) * period_s);
    return least;
}

// Where cycle 0 begins: no frame is early, and the first few are not all late.
double first_start(const std::vector<double>& arrivals, double period_s) {
    double start = arrivals[0];
    for (std::size_t i = 0; i < std::min(arrivals.size(), kFirst); ++i)
        start = std::min(start, arrivals[i] - double(i) * period_s);
    return start;
}

// By how many cycles arrival i lies off: back where it is early itself, forward where it and the
// next few are all late. The last few have nobody to agree with: what is late there is late.
void number(const std::vector<double>& arrivals, FittedClock& clock) {
    clock.cycle.assign(arrivals.size(), 0);
    const double period = clock.period_s;
    double start = first_start(arrivals, period);
    long next = 0;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const double expected = start + double(next) * period, own = arrivals[i] - expected;
        const double lasting = lasting_delay(arrivals, i, expected, period);
        const bool agreed = i + kAhead <= arrivals.size();
        long missed = 0;
        if (own < -period / 2)
            missed = std::max(-next, std::lround(own / period));
        else if (agreed)
            missed = std::max(0L, std::lround(lasting / period));
        clock.cycle[i] = next + missed;
        next = clock.cycle[i] + 1;
        const double off = lasting - double(missed) * period;
        if (std::abs(off) < period / 2) start += kFollow * off;
    }
}

void refuse_if_few(const std::vector<double>& arrivals) {
    if (arrivals.size() < kFewest)
        throw Refusal("fewer than 8 frames hold what is asked for", "more cycles of the move");
}

// The straight line through arrivals over cycles.
void fit_line(const std::vector<double>& arrivals, FittedClock& clock, bool stated) {
    const double n = double(arrivals.size());
    double k = 0, t = 0, kk = 0, kt = 0;
    for (std::size_t i = 0; i < arrivals.size(); ++i)
        k += double(clock.cycle[i]) / n, t += (arrivals[i] - arrivals[0]) / n;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const double dk = double(clock.cycle[i]) - k, dt = arrivals[i] - arrivals[0] - t;
        kk += dk * dk, kt += dk * dt;
    }
    if (!stated && kk > 0) clock.period_s = kt / kk;
    clock.start_s = arrivals[0] + t - k * clock.period_s;
}

void judge_arrivals(const std::vector<double>& arrivals, FittedClock& clock) {
    double square = 0;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const double late = arrivals[i] - clock.start_s - double(clock.cycle[i]) * clock.period_s;
        square += late * late;
        clock.latest_s = std::max(clock.latest_s, late);
    }
    clock.jitter_s = std::sqrt(square / double(arrivals.size()));
}

} // namespace

FittedClock fit_clock(const std::vector<double>& arrivals, std::optional<double> period_s) {
    refuse_if_few(arrivals);
    FittedClock out;
    out.period_s = period_s.value_or(median_step(arrivals));
    if (!(out.period_s > 0))
        throw Refusal("most frames carry the same time",
                      "a log whose times are finer than the cycle, or map a counter");
    for (int pass = 0; pass < 3; ++pass) {
        number(arrivals, out);
        fit_line(arrivals, out, period_s.has_value());
    }
    judge_arrivals(arrivals, out);
    return out;
}

FittedClock counted_clock(const std::vector<double>& arrivals, std::optional<double> period_s) {
    refuse_if_few(arrivals);
    FittedClock out;
    out.cycle.resize(arrivals.size());
    std::iota(out.cycle.begin(), out.cycle.end(), 0L);
    out.period_s = period_s.value_or(0);
    fit_line(arrivals, out, period_s.has_value());
    judge_arrivals(arrivals, out);
    return out;
}

FittedClock line_through(const std::vector<double>& arrivals, const std::vector<long>& cycle) {
    refuse_if_few(arrivals);
    FittedClock out;
    out.cycle = cycle;
    fit_line(arrivals, out, false);
    judge_arrivals(arrivals, out);
    return out;
}

std::vector<long> unrolled(const std::vector<std::int64_t>& counts, int bits) {
    std::vector<long> out;
    const std::int64_t range = bits < 63 ? std::int64_t{1} << bits : 0;
    long high = 0; // of the furthest so far
    for (std::int64_t count : counts) {
        if (out.empty() || range == 0) {
            out.push_back(long(count));
        } else {
            std::int64_t step = (count - high) % range;
            if (step < 0) step += range;
            if (step >= range / 2) step -= range;
            out.push_back(high + long(step));
        }
        high = out.size() == 1 ? out.back() : std::max(high, out.back());
    }
    return out;
}

} // namespace servoid::can
