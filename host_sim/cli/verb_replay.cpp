// servoid replay: captured bus traffic through the firmware core.
#include "can/bus_log.hpp"
#include "cli/bus_options.hpp"
#include "cli/identify_output.hpp"
#include "common/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    BusOptions bus;
    IdentifyArguments identify;
    std::string log, out;
};

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

// The stretch that tells most.
const Capture& longest(const std::vector<Capture>& captures) {
    return *std::max_element(
        captures.begin(), captures.end(),
        [](const Capture& a, const Capture& b) { return a.rows() < b.rows(); });
}

void run_replay(const Options& o) {
    const std::optional<Model> model = o.identify.read_model();
    const Model* known = model ? &*model : nullptr;
    const can::BusCaptures log =
        can::read_candump(o.log, o.bus.frame_map(), known ? scales_of(*known) : CaptureScales{});
    print_bus(o.output, log);
    const Capture& capture = longest(log.captures);
    if (!o.out.empty()) write_file(o.out, format_capture_csv(capture));
    const auto all = identify_all({capture}, o.identify.options(known));
    Json json = identification_json(all, capture);
    json["bus"] = bus_json(log.report);
    o.output.print_json(json);
    print_identification(o.output, all, capture);
}

} // namespace

void add_replay(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "replay", "captured CAN traffic through the firmware core");
    verb.add_option("log", o->log, "candump log (candump -l, -L)").required();
    add_bus_options(verb, o->bus);
    add_identify_options(verb, o->identify);
    verb.add_option("--out", o->out, "also write the longest stretch without a gap as .csv");
    add_output_options(verb, o->output);
    verb.examples("  servoid replay can0.log --profile cia402 --model motor.toml\n"
                  "  servoid replay can0.log --map drive.toml --out move.csv\n"
                  "  servoid replay can0.log --dbc drive.dbc --torque Drive.Torque:Nm --position "
                  "Drive.Position:rad");
    verb.callback([o] { run_replay(*o); });
}

} // namespace servoid::cli
