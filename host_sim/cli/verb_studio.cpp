// servoid studio: the page, live, on this machine.
#include "cli/app.hpp"
#include "cli/end_on_signal.hpp"
#include "cli/next_commands.hpp"
#include "common/error.hpp"
#include "studio/server.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
    int port = 0;
    bool no_diagnose = false;
    studio::BusSetup bus;
};

std::string command_of(const Options& o) {
    std::string out = "servoid studio " + shell_word(o.model);
    for (const std::string& file : o.captures.files)
        out += " " + shell_word(file);
    return out + options_of(o.captures);
}

// A log may hold several captures: each is one of its own.
std::vector<studio::Recording> recordings_of(const Options& o, const Model& model) {
    std::vector<studio::Recording> out;
    for (const std::string& file : o.captures.files)
        for (Capture& capture : o.captures.read_files({file}, &model, o.output))
            out.push_back({std::move(capture), source_file(file), true});
    return out;
}

studio::Setup setup_of(const Options& o) {
    const Model model = read_model(o.model);
    const CaptureOptions captures = o.captures;
    Output silent; // the page shows how far it is
    silent.quiet = true;
    return {model,
            source_file(o.model),
            recordings_of(o, model),
            o.captures.motion(),
            {command_of(o)},
            [captures, model, silent](const std::string& path) {
                return captures.read_files({path}, &model, silent);
            },
            o.bus,
            !o.no_diagnose};
}

void run_studio(const Options& o) {
    studio::Studio studio(setup_of(o));
    studio::Server server(studio, o.port);
    const EndOnSignal signals;
    server.start();
    o.output.print_json({{"schema", "servoid.studio/1"}, {"url", server.url()}});
    o.output.line("studio at " + o.output.bold(server.url()));
    o.output.line("Open it in a browser on this machine. Ctrl-C ends it; save the model before.");
    std::cout << std::flush;
    while (!EndOnSignal::wanted())
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.stop();
}

} // namespace

void add_studio(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "studio", "the same page, live: add, undo, edit, save");
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    verb.add_option("--port", o->port, "to listen on (default: any that is free)")
        .between(1, 65535);
    verb.add_flag("--no-diagnose", o->no_diagnose, "diagnose only when asked");
    verb.add_option("--can", o->bus.interface, "run experiments on a drive of this bus: can0");
    verb.add_option("--node", o->bus.link.node, "number of the drive (default 1)").between(1, 127);
    verb.add_option("--torque-limit", o->bus.limits.torque,
                    "N·m or N at which the drive holds its axis (default: its own)")
        .positive();
    verb.add_option("--stroke", o->bus.limits.stroke,
                    "rad or m from the start of a run at which the drive holds its axis")
        .positive();
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid studio model.toml run.csv\n"
                  "  servoid studio model.toml a.csv b.csv --port 8080\n"
                  "  servoid studio model.toml run.csv --can can0 --stroke 6.5");
    verb.callback([o] { run_studio(*o); });
}

} // namespace servoid::cli
