// servoid replay: captured or live bus traffic through the firmware core.
#include "can/bus_log.hpp"
#include "cli/bus_options.hpp"
#include "cli/bus_output.hpp"
#include "cli/identify_output.hpp"
#include "cli/replay_live.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

#include <nlohmann/json.hpp>

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
    const Verb verb(app, "replay", "captured or live CAN traffic through the firmware core");
    verb.add_option("LOG", o->log, "candump log (candump -l, -L)");
    add_live_options(verb, o->live);
    add_bus_options(verb, o->bus);
    add_identify_options(verb, o->identify);
    verb.add_option("--out", o->out, "also write the longest stretch without a gap as .csv");
    add_output_options(verb, o->output);
    verb.examples("  servoid replay can0.log --profile cia402 --model motor.toml\n"
                  "  servoid replay can0.log --map drive.toml --out move.csv\n"
                  "  servoid replay --can can0 --map drive.toml --for 10 --log heard.log\n"
                  "  servoid replay can0.log --dbc drive.dbc --torque Drive.Torque:Nm --position "
                  "Drive.Position:rad");
    verb.callback([o] { run_replay(*o); });
}

} // namespace servoid::cli
