#include "blind/moves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// One leg from 0 to `way`, speed and acceleration limited.
struct Leg {
    double way, speed, acceleration;
    double top() const { return std::min(speed, std::sqrt(way * acceleration)); }
    double duration() const { return way / top() + top() / acceleration; }
    double at(double t) const {
        const double v = top(), rise = v / acceleration, end = duration();
        t = std::clamp(t, 0.0, end);
        if (t < rise) return acceleration * t * t / 2;
        if (t > end - rise) return way - acceleration * (end - t) * (end - t) / 2;
        return v * (t - rise / 2);
    }
};

// The same for ever: t within one period, and how a move of `repeats` periods looks.
Move repeated(Move one, int repeats) {
    one.duration_s = one.period_s * repeats;
    one.at = [inner = one.at, p = one.period_s](double t) { return inner(std::fmod(t, p)); };
    if (repeats < 2) one.period_s = 0;
    return one;
}

} // namespace

std::vector<double> Move::sample(double step_s, double amplitude) const {
    const auto count = static_cast<size_t>(duration_s / step_s);
    std::vector<double> out(count);
    for (size_t k = 0; k < count; ++k)
        out[k] = amplitude * at(static_cast<double>(k) * step_s);
    return out;
}

Move speeds(const SpeedsRequest& request) {
    struct Part {
        double start;
        Leg leg;
    };
    std::vector<Part> parts;
    double length = 0;
    const double longest = *std::max_element(request.speeds.begin(), request.speeds.end());
    for (double v : request.speeds) {
        const double share = request.whole_way ? 1 : v / longest;
        const Leg leg{request.stroke * share, v, request.acceleration};
        parts.push_back({length, leg});
        length += 2 * (leg.duration() + request.dwell_s);
    }
    Move move;
    move.kind = request.whole_way ? "speeds, whole way" : "speeds";
    move.period_s = length;
    move.top_Hz = 0;
    move.at = [parts, dwell = request.dwell_s](double t) {
        const Part* part = &parts.front();
        for (const Part& p : parts)
            if (t >= p.start) part = &p;
        const double in = t - part->start, half = part->leg.duration() + dwell;
        return in < half ? part->leg.at(in) : part->leg.way - part->leg.at(in - half);
    };
    return repeated(move, request.cycles);
}

Move multisine(const MultisineRequest& request, Random& random) {
    struct Line {
        double w, amplitude, phase;
    };
    std::vector<Line> lines;
    double power = 0;
    const int first = std::max(1, static_cast<int>(std::lround(request.from_Hz / request.base_Hz)));
    for (int k = first; k * request.base_Hz <= request.top_Hz * (1 + 1e-9); ++k) {
        const double f = k * request.base_Hz;
        lines.push_back(
            {kTurn * f, std::pow(f / request.base_Hz, -request.slope), random.uniform(0, kTurn)});
        power += lines.back().amplitude * lines.back().amplitude / 2;
    }
    for (Line& line : lines)
        line.amplitude /= std::sqrt(power);
    Move move;
    move.kind = "multisine";
    move.period_s = 1 / request.base_Hz;
    move.top_Hz = request.top_Hz;
    move.at = [lines](double t) {
        double sum = 0;
        for (const Line& line : lines)
            sum += line.amplitude * (std::sin(line.w * t + line.phase) - std::sin(line.phase));
        return sum;
    };
    return repeated(move, request.periods);
}

Move sines(const std::vector<double>& frequencies_Hz, double slope, int cycles_each, int repeats) {
    struct Part {
        double start, end, f, amplitude;
    };
    std::vector<Part> parts;
    double t = 0;
    for (double f : frequencies_Hz) {
        const double cycles = std::max<double>(cycles_each, std::ceil(0.2 * f));
        parts.push_back({t, t + cycles / f, f, std::pow(f / frequencies_Hz.front(), -slope)});
        t = parts.back().end;
    }
    Move move;
    move.kind = "sines";
    move.period_s = t;
    move.top_Hz = *std::max_element(frequencies_Hz.begin(), frequencies_Hz.end());
    move.at = [parts](double when) {
        for (const Part& p : parts) {
            if (when >= p.end) continue;
            const double in = when - p.start, edge = 0.5 / p.f;
            const double soft = std::min({1.0, in / edge, (p.end - when) / edge});
            return p.amplitude * soft * std::sin(kTurn * p.f * in);
        }
        return 0.0;
    };
    return repeated(move, repeats);
}

Move chirp(double from_Hz, double top_Hz, double slope, double sweep_s, int repeats) {
    const double rate = std::log(top_Hz / from_Hz) / sweep_s;
    Move move;
    move.kind = "chirp";
    move.period_s = 2 * sweep_s;
    move.top_Hz = top_Hz;
    move.at = [=](double t) {
        const double up = t < sweep_s ? t : 2 * sweep_s - t;
        const double phase = kTurn * from_Hz * std::expm1(rate * up) / rate;
        return std::exp(-slope * rate * up) * std::sin(phase);
    };
    return repeated(move, repeats);
}

} // namespace blind
