// servoid replay: captured or live bus traffic through the firmware core.
#include "can/bus_log.hpp"
#include "cli/bus_options.hpp"
#include "cli/identify_output.hpp"
#include "cli/replay_live.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

#include <fmt/format.h>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    BusOptions bus;
    LiveOptions live;
    IdentifyArguments identify;
    std::string log, out;
};

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
            {"clock", bus.clock},
            {"period_s", bus.period_s},
            {"bus_off", bus.bus_off},
            {"restarted", bus.restarted},
            {"error_passive", bus.error_passive},
            {"error_warning", bus.error_warning},
            {"interface_down", bus.interface_down}};
}

// Only what happened: most buses have nothing of it.
std::string troubles(const can::BusReport& bus) {
    std::string out;
    const auto tell = [&](const char* what, long times) {
        if (times > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", what, times);
    };
    tell("bus off", bus.bus_off), tell("restarted", bus.restarted);
    tell("error passive", bus.error_passive), tell("error warning", bus.error_warning);
    tell("interface down", bus.interface_down);
    return out;
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

void run_replay(const Options& o) {
    const std::optional<Model> model = o.identify.read_model();
    const Model* known = model ? &*model : nullptr;
    const CaptureScales scales = known ? scales_of(*known) : CaptureScales{};
    const bool live = !o.live.interface.empty();
    if (live == !o.log.empty())
        throw UsageError("what to replay: either a candump LOG or --can INTERFACE");
    const can::FrameMap map = o.bus.frame_map();
    const can::BusCaptures log = live ? record_live(o.live, map, scales, o.output, o.out)
                                      : can::read_candump(o.log, map, scales);
    print_bus(o.output, log, live);
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
    CLI::App* verb =
        app.add_subcommand("replay", "captured or live CAN traffic through the firmware core");
    verb->add_option("LOG", o->log, "candump log (candump -l, -L)");
    add_live_options(*verb, o->live);
    add_bus_options(*verb, o->bus);
    add_identify_options(*verb, o->identify);
    verb->add_option("--out", o->out, "also write the longest stretch without a gap as .csv");
    add_output_options(*verb, o->output);
    add_examples(*verb,
                 "  servoid replay can0.log --profile cia402 --model motor.toml\n"
                 "  servoid replay can0.log --map drive.toml --out move.csv\n"
                 "  servoid replay --can can0 --map drive.toml --for 10 --log heard.log\n"
                 "  servoid replay can0.log --dbc drive.dbc --torque Drive.Torque:Nm --position "
                 "Drive.Position:rad");
    verb->callback([o] { run_replay(*o); });
}

} // namespace servoid::cli
