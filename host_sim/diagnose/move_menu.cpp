#include "diagnose/move_menu.hpp"

#include "common/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kAccelerate = 0.6;  // of the torque; the rest is for friction and overshoot
constexpr double kUsual_rows = 5000; // of a record: what is seen in it does not grow with more
constexpr double kMost_rows = 16000; // what simulating and fitting one costs goes with it
constexpr double kFewestCycles = 2, kUsualCycles = 3; // repetition shows the noise

struct Scale {
    double stroke, speed, acceleration, usual_s, most_s;
};

Scale scale_of(const MoveLimits& limits, double inertia) {
    const double step = limits.sample_time_s;
    return {limits.travel(), limits.asked_speed, kAccelerate * limits.peak_torque / inertia,
            kUsual_rows * step, std::min(limits.longest_s, kMost_rows * step)};
}

// Repetitions that fill a usual record; nothing where not even the fewest fit.
std::optional<double> cycles_of(double period_s, const Scale& scale) {
    const double usual = std::ceil(scale.usual_s / period_s);
    const double most = std::floor(scale.most_s / period_s);
    if (most < kFewestCycles) return std::nullopt;
    return std::min(most, std::max(kUsualCycles, usual));
}

struct Menu {
    const Scale& scale;
    std::vector<Move> moves;

    void add(const std::string& kind, std::vector<std::pair<std::string, double>> keys,
             const char* effort, double most_effort) {
        keys.emplace_back(kind.ends_with("sine") ? "periods" : "cycles", kFewestCycles);
        Move move{kind, std::move(keys), effort, most_effort};
        std::string text = kind + ":";
        for (const auto& [key, value] : move.keys)
            text += fmt::format("{}{}={:.6g}", text.back() == ':' ? "" : ",", key, value);
        try {
            const std::optional<double> cycles = cycles_of(*parse_experiment(text).period_s, scale);
            if (!cycles) return;
            move.keys.back().second = *cycles;
            const auto same = [&](const Move& m) { return m.keys == move.keys; };
            if (std::none_of(moves.begin(), moves.end(), same)) moves.push_back(std::move(move));
        } catch (const UsageError&) { // an axis so slow that the move lasts more than an hour
        }
    }

    void trapezoid(double stroke, double speed, double acceleration) {
        add("trapezoid",
            {{"stroke", stroke * scale.stroke},
             {"velocity", speed * scale.speed},
             {"acceleration", acceleration * scale.acceleration}},
            "acceleration", 1);
    }
    // Over as much of the stroke as leaves time for the fewest repetitions.
    void staircase(double stroke, double from, double to) {
        constexpr int count = 4;
        double per_stroke = 0;
        for (int i = 0; i < count; ++i)
            per_stroke += 2 / (scale.speed * (from + (to - from) * i / (count - 1)));
        const double longest = 0.9 * scale.most_s / (kFewestCycles * per_stroke);
        add("staircase",
            {{"stroke", std::min(stroke * scale.stroke, longest)},
             {"from", from * scale.speed},
             {"to", to * scale.speed},
             {"count", count},
             {"acceleration", scale.acceleration}},
            "acceleration", 1);
    }
    // What travel, speed and torque allow an axis that follows.
    double amplitude(double frequency_Hz) const {
        const double w = kTurn * frequency_Hz;
        return std::min({scale.stroke / 2, scale.speed / w, scale.acceleration / (w * w)});
    }
    void sine(double frequency_Hz, double share) {
        const double a = share * amplitude(frequency_Hz);
        add("sine", {{"frequency_Hz", frequency_Hz}, {"amplitude", a}}, "amplitude",
            share * scale.stroke / 2 / a);
    }
    // Lines of one amplitude: the highest decides on speed and torque.
    void multisine(double top_Hz, double share) {
        constexpr int lines = 12;
        const double most = scale.stroke / 6; // the crest of so many lines
        const double a = share * std::min(most, amplitude(top_Hz));
        const double step = top_Hz / lines;
        add("multisine",
            {{"from_Hz", step}, {"to_Hz", top_Hz}, {"step_Hz", step}, {"amplitude", a}},
            "amplitude", share * most / a);
    }
};

} // namespace

std::vector<Move> menu_of(const MoveLimits& limits, double inertia) {
    const Scale scale = scale_of(limits, inertia);
    Menu menu{scale, {}};
    // Where stroke and speed, and where speed and torque, are used up together.
    const double slow_Hz = scale.speed / (kTurn * scale.stroke / 2);
    const double fast_Hz = std::max(scale.acceleration / (kTurn * scale.speed), 2 * slow_Hz);
    for (const double stroke : {1.0, 0.6, 0.3})
        for (const double speed : {0.2, 0.5, 1.0})
            menu.trapezoid(stroke, speed, speed < 0.3 ? 0.25 : 1);
    menu.staircase(1, 0.2, 1);
    for (const double times : {0.5, 1.0, 2.0, 4.0, 8.0})
        menu.multisine(times * fast_Hz, 1);
    menu.multisine(2 * fast_Hz, 0.3);
    menu.sine(slow_Hz, 1), menu.sine(slow_Hz, 0.05);
    for (const double times : {0.5, 1.0, 3.0})
        menu.sine(times * fast_Hz, 1);
    menu.staircase(0.3, 0.2, 1), menu.staircase(0.1, 0.2, 1), menu.staircase(0.1, 0.05, 0.5);
    for (const double speed : {0.2, 1.0})
        menu.trapezoid(0.1, speed, 1);
    return std::move(menu.moves);
}

namespace {

struct Range {
    double lowest, highest;
};

Range range_of(const Experiment& experiment) {
    constexpr int points = 4000;
    Range out{0, 0};
    for (int i = 0; i < points; ++i) {
        const double at = experiment.position_ref(*experiment.period_s * i / points);
        out.lowest = std::min(out.lowest, at), out.highest = std::max(out.highest, at);
    }
    return out;
}

} // namespace

std::optional<std::string> text_of(const Move& move, double effort, const MoveLimits& limits) {
    std::string text = move.kind;
    for (const auto& [key, value] : move.keys)
        text += fmt::format("{}{}={:.4g}", text == move.kind ? ":" : ",", key,
                            key == move.effort ? effort * value : value);
    const Experiment experiment = parse_experiment(text);
    if (experiment.duration_s > limits.longest_s) return std::nullopt;
    const Range range = range_of(experiment);
    // A thousandth of the travel is exact enough, and a start at zero goes without saying.
    const double unit = std::pow(10, std::floor(std::log10(limits.travel())) - 2);
    const double start = (limits.lowest + limits.highest - range.lowest - range.highest) / 2;
    const double rounded = std::round(start / unit) * unit;
    if (rounded != 0) text += fmt::format(",start={:.10g}", rounded);
    return text;
}

} // namespace servoid
