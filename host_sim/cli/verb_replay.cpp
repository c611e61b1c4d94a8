// servoid replay: captured bus traffic through the firmware core.
#include "can/bus_log.hpp"
#include "cli/bus_options.hpp"
#include "cli/bus_output.hpp"
#include "cli/identify_output.hpp"
#include "common/file.hpp"

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    BusOptions bus;
    IdentifyArguments identify;
    std::string log, out;
};

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
    CLI::App* verb = app.add_subcommand("replay", "captured CAN traffic through the firmware core");
    verb->add_option("log", o->log, "candump log (candump -l, -L)")->required();
    add_bus_options(*verb, o->bus);
    add_identify_options(*verb, o->identify);
    verb->add_option("--out", o->out, "also write the longest stretch without a gap as .csv");
    add_output_options(*verb, o->output);
    add_examples(*verb,
                 "  servoid replay can0.log --profile cia402 --model motor.toml\n"
                 "  servoid replay can0.log --map drive.toml --out move.csv\n"
                 "  servoid replay can0.log --dbc drive.dbc --torque Drive.Torque:Nm --position "
                 "Drive.Position:rad");
    verb->callback([o] { run_replay(*o); });
}

} // namespace servoid::cli
