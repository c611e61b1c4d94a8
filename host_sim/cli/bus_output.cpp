#include "cli/bus_output.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid::cli {

Json bus_json(const can::BusReport& bus) {
    return {{"frames", bus.frames},       {"lost", bus.lost},          {"repeated", bus.repeated},
            {"late", bus.late},           {"jitter_s", bus.jitter_s},  {"used", bus.used},
            {"reordered", bus.reordered}, {"short", bus.short_frames}, {"errors", bus.errors},
            {"dropped", bus.dropped},     {"clock", bus.clock},        {"period_s", bus.period_s}};
}

void print_bus(const Output& out, const can::BusCaptures& log) {
    const can::BusReport& bus = log.report;
    out.line(fmt::format("{} frames, {} used, {} lost, {} repeated, {} late, {} reordered, {} too "
                         "short, {} dropped by the logger, {} errors of the bus",
                         bus.frames, bus.used, bus.lost, bus.repeated, bus.late, bus.reordered,
                         bus.short_frames, bus.dropped, bus.errors));
    out.line(fmt::format("cycle {:.6g} ms from {}; the arrivals jitter by {:.3g} ms; {} stretch{} "
                         "without a gap",
                         1e3 * bus.period_s, bus.clock, 1e3 * bus.jitter_s, log.captures.size(),
                         log.captures.size() == 1 ? "" : "es"));
}

const Capture& longest(const std::vector<Capture>& captures) {
    return *std::max_element(
        captures.begin(), captures.end(),
        [](const Capture& a, const Capture& b) { return a.rows() < b.rows(); });
}

} // namespace servoid::cli
