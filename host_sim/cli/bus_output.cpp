#include "cli/bus_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace servoid::cli {

namespace {

// Only what happened: most buses have nothing of it.
std::string troubles(const can::BusReport& bus) {
    std::string out;
    const auto tell = [&](const char* what, long times) {
        if (times > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", what, times);
    };
    tell("bus off", bus.bus_off), tell("restarted", bus.restarted);
    tell("error passive", bus.error_passive), tell("error warning", bus.error_warning);
    tell("interface down", bus.interface_down), tell("the drive was reset", bus.resets);
    return out;
}

} // namespace

Json bus_json(const can::BusReport& bus) {
    return {{"frames", bus.frames},
            {"lost", bus.lost},
            {"repeated", bus.repeated},
            {"late", bus.late},
            {"jitter_s", bus.jitter_s},
            {"used", bus.used},
            {"reordered", bus.reordered},
            {"short", bus.short_frames},
            {"errors", bus.errors},
            {"dropped", bus.dropped},
            {"resets", bus.resets},
            {"clock", bus.clock},
            {"period_s", bus.period_s},
            {"bus_off", bus.bus_off},
            {"restarted", bus.restarted},
            {"error_passive", bus.error_passive},
            {"error_warning", bus.error_warning},
            {"interface_down", bus.interface_down}};
}

void print_bus(const Output& out, const can::BusCaptures& log, bool live) {
    const can::BusReport& bus = log.report;
    out.line(fmt::format("{} frames, {} used, {} lost, {} repeated, {} late, {} reordered, {} too "
                         "short, {} dropped{}, {} errors of the bus",
                         bus.frames, bus.used, bus.lost, bus.repeated, bus.late, bus.reordered,
                         bus.short_frames, bus.dropped, live ? "" : " by the logger", bus.errors));
    if (const std::string said = troubles(bus); !said.empty()) out.line("the bus: " + said);
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
