#include "node/go_and_move.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

double fastest_of(const Experiment& experiment) {
    double out = 0;
    const double h = experiment.duration_s / 1000;
    for (int i = 1; i <= 1000; ++i)
        out = std::max(
            out,
            std::fabs(experiment.position_ref(i * h) - experiment.position_ref((i - 1) * h)) / h);
    return out;
}

// A half cosine from where the axis stands to where the experiment begins, at half of its speed.
Experiment approach(const Experiment& experiment, double from, double to) {
    constexpr double pi = std::numbers::pi;
    const double way = to - from;
    Experiment out;
    out.text = "approach";
    out.duration_s =
        std::max(0.2, pi / 2 * std::fabs(way) / std::max(fastest_of(experiment) / 2, 1e-9));
    out.position_ref = [=, d = out.duration_s](double t) {
        return from + way * (1 - std::cos(pi * std::min(1.0, t / d))) / 2;
    };
    return out;
}

} // namespace

RunEnd go_and_move(Master& master, Link& link, const Experiment& experiment,
                   const OnProgress& progress, const Note& note) {
    const double stands = master.position();
    RunEnd end;
    if (experiment.start != 0 && std::fabs(experiment.start - stands) > master.scales().count) {
        note(fmt::format("going from {:.4g} to {:.4g} first", stands, experiment.start));
        end = master.move(approach(experiment, stands, experiment.start), progress);
        link.wait(0.5);
        if (end.fault.empty()) link.forget_telemetry();
    }
    if (end.fault.empty()) end = master.move(experiment, progress);
    master.finish();
    return end;
}

} // namespace servoid
