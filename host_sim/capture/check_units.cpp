// Unit mistakes that only the numbers give away: wrapped positions, and a velocity that is not the
// derivative of the position.
#include "capture/checks.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace servoid {

namespace {

// First row where the position jumps by about one period of a wrapping counter against the motion
// before or after, or 0. A wrapped column never leaves one period, which clears every real motion
// that is longer and every one that is much shorter.
size_t find_wrap(const std::vector<double>& x, double period) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    const double range = *high - *low;
    if (range < 0.5 * period || range > 1.001 * period) return 0;
    for (size_t i = 1; i < x.size(); ++i) {
        const double jump = x[i] - x[i - 1];
        if (std::abs(jump) < 0.5 * period) continue;
        const double before = i > 1 ? x[i - 1] - x[i - 2] : jump;
        const double after = i + 1 < x.size() ? x[i + 1] - x[i] : jump;
        for (const double usual : {before, after})
            if (std::abs(usual) < 0.4 * period &&
                std::abs(std::abs(jump - usual) - period) < 0.1 * period)
                return i;
    }
    return 0;
}

[[noreturn]] void fail_wrapped(const RawTable& table, const RawColumn& column, size_t row,
                               const std::string& period) {
    const auto& x = column.values;
    table.fail_row(
        row,
        fmt::format("column {}: position looks wrapped: it jumps from {:.6g} to {:.6g}, by {}; "
                    "unwrap it before use",
                    in_quotes(column.name), x[row - 1], x[row], period));
}

// How the velocity would have to be scaled to be the derivative of the position, and how surely.
struct Slope {
    double ratio = 0; // d(position) / integral of velocity
    double correlation = 0;
};

// Compares differences of the position with the integrated velocity over pieces of `length` rows:
// long pieces drown the sensor's steps, short ones follow fast motion.
Slope slope_over(size_t length, const std::vector<double>& t, const std::vector<double>& x,
                 const std::vector<double>& v) {
    double xx = 0, xv = 0, vv = 0;
    for (size_t start = 0; start + length < x.size(); start += length) {
        double moved = 0;
        for (size_t i = start; i < start + length; ++i)
            moved += 0.5 * (v[i] + v[i + 1]) * (t[i + 1] - t[i]);
        const double difference = x[start + length] - x[start];
        xx += difference * difference;
        xv += difference * moved;
        vv += moved * moved;
    }
    if (xx <= 0 || vv <= 0) return {};
    return {xv / vv, xv / std::sqrt(xx * vv)};
}

Slope best_slope(const std::vector<double>& t, const std::vector<double>& x,
                 const std::vector<double>& v) {
    Slope best;
    for (size_t length = 1; length * 8 < x.size(); length *= 4) {
        const Slope slope = slope_over(length, t, x, v);
        if (std::abs(slope.correlation) > std::abs(best.correlation)) best = slope;
    }
    return best;
}

struct KnownFactor {
    double factor; // derivative of the position / velocity
    const char* reason;
};

constexpr double two_pi = 2 * std::numbers::pi;
// Grouped by what was probably mixed up; each also read the other way round.
constexpr KnownFactor known_factors[] = {
    {1000, "mm taken for m, or ms for s"},
    {1e6, "us taken for s"},
    {360 / two_pi, "degrees taken for radians"},
    {360, "degrees taken for revolutions"},
    {60, "rpm taken for rev/s, or min for s"},
    {60 / two_pi, "rpm taken for rad/s"},
    {6, "rpm taken for deg/s"},
    {two_pi, "revolutions taken for radians"},
};

std::string likely_mistake(double ratio) {
    for (const auto& [factor, reason] : known_factors) {
        const double off = std::max(ratio / factor, factor / ratio);
        const double off_inverse = std::max(ratio * factor, 1 / (ratio * factor));
        // 57.3 and 60 are near each other; the nearer one must win.
        if (std::min(off, off_inverse) < 1.02) return reason;
    }
    return "";
}

} // namespace

void check_unwrapped(const RawTable& table, const RawColumn& column, double turn, double quantum) {
    if (turn > 0)
        if (const size_t row = find_wrap(column.values, turn))
            fail_wrapped(table, column, row, "about one revolution");
    if (quantum <= 0) return;
    for (int bits = 8; bits <= 32; ++bits)
        if (const size_t row = find_wrap(column.values, std::ldexp(quantum, bits)))
            fail_wrapped(table, column, row, fmt::format("about 2^{} counts", bits));
}

void check_velocity_unit(const RawTable& table, const std::vector<double>& time_s,
                         const std::vector<double>& position, const std::vector<double>& velocity) {
    const Slope slope = best_slope(time_s, position, velocity);
    if (std::abs(slope.correlation) < 0.9) return; // noise or standstill: nothing can be said
    const std::string columns = in_quotes(table.find(Signal::position)->name) + " and " +
                                in_quotes(table.find(Signal::velocity)->name);
    if (slope.ratio < 0)
        table.fail_header("columns " + columns +
                          " run opposite ways; expected the velocity to be "
                          "the derivative of the position");
    if (slope.ratio > 0.5 && slope.ratio < 2) return; // a filtered velocity may be off that much
    const std::string likely = likely_mistake(slope.ratio);
    table.fail_header(
        fmt::format("columns {}: the position changes {:.4g} times as fast as the velocity says; a "
                    "unit is wrong{}",
                    columns, slope.ratio, likely.empty() ? "" : " (" + likely + "?)"));
}

} // namespace servoid
