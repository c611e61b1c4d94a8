// servoid identify: inertia of a captured periodic move, by the firmware core.
#include "cli/identify_output.hpp"

#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    IdentifyArguments identify;
};

void run_identify(const Options& o) {
    const std::optional<Model> model = o.identify.read_model();
    const Model* known = model ? &*model : nullptr;
    const std::vector<Capture> captures = o.captures.read(known, o.output);
    const auto all = identify_all(captures, o.identify.options(known));
    o.output.print_json(identification_json(all, captures.front()));
    print_identification(o.output, all, captures.front());
}

} // namespace

void add_identify(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "identify",
                    "inertia, viscous friction and constant torque, by the firmware core itself");
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log) of a periodic move")
        .required();
    verb.add_option("--map", o->captures.map, "TOML file that names foreign columns");
    add_identify_options(verb, o->identify);
    add_output_options(verb, o->output);
    verb.examples("  servoid identify sine.csv\n"
                  "  servoid identify sine.csv --frequency 100 --json\n"
                  "  servoid identify bench.csv --model motor.toml --window 2 10");
    verb.callback([o] { run_identify(*o); });
}

} // namespace servoid::cli
