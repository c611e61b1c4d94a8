// servoid simulate: a capture of the simulated drive.
#include "can/bus_log.hpp"
#include "cli/app.hpp"
#include "cli/progress.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "mystery/mystery.hpp"
#include "mystery/secret.hpp"
#include "plant/simulate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string model, experiment, out;
    unsigned long seed = 1;
    std::optional<std::uint64_t> mystery;
};

// The capture, with one effect more than the model says where a mystery was asked for.
Capture make_capture(const Options& o, const Model& model) {
    const Experiment experiment = parse_experiment(o.experiment);
    const ProgressLine line(o.output);
    if (!o.mystery) return simulate(model, experiment, o.seed, line.progress());
    line.phase("choosing what to hide");
    const Mystery mystery = make_mystery(model, experiment, *o.mystery, o.seed);
    Capture capture =
        simulate(with_hidden(model, mystery.hidden), experiment, o.seed, line.progress());
    capture.metadata[kMysteryKey] = std::to_string(mystery.seed);
    capture.metadata[kSecretKey] = encode_secret(mystery);
    return capture;
}

void say_what_to_do(const Options& o) {
    o.output.line(fmt::format("one effect that {0} lacks is hidden in it; look for it with\n"
                              "  servoid diagnose {0} {1}\n"
                              "and when you know, or give up:\n"
                              "  servoid reveal {1}",
                              o.model, o.out));
}

void run_simulate(const Options& o) {
    const Model model = read_model(o.model);
    const Capture capture = make_capture(o, model);
    write_file(o.out, o.out.ends_with(".log") ? can::format_candump_log(capture, scales_of(model))
                                              : format_capture_csv(capture));
    Json json = {{"schema", "servoid.simulate/1"},
                 {"out", o.out},
                 {"samples", capture.rows()},
                 {"sample_time_s", capture.sample_time_s},
                 {"seed", o.seed}};
    if (o.mystery) json["mystery"] = *o.mystery;
    o.output.print_json(json);
    if (o.out == "-") return;
    o.output.line(fmt::format("wrote {}: {} samples, {:.4g} s", o.out, capture.rows(),
                              double(capture.rows()) * capture.sample_time_s));
    if (o.mystery) say_what_to_do(o);
}

} // namespace

void add_simulate(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "simulate", "a capture of the simulated drive");
    verb.add_option("model", o->model, "model file (TOML) with a [controller]").required();
    verb.add_option("--experiment", o->experiment,
                    "KIND:KEY=VALUE,... or a .toml file; kinds: sine, multisine, trapezoid, "
                    "constant_speed, speeds, staircase")
        .required();
    verb.add_option("--seed", o->seed, "of the noise");
    verb.add_option("--mystery", o->mystery,
                    "hide one effect that the model lacks; this seed chooses it (servoid reveal "
                    "tells)");
    verb.add_option("--out", o->out,
                    "capture file (.csv, or .log as candump writes it), - for stdout")
        .required();
    add_output_options(verb, o->output);
    verb.examples(
        "  servoid simulate system1.toml --experiment sine:frequency_Hz=100 --out a.csv\n"
        "  (an experiment without a known key answers with the keys of its kind)\n"
        "  servoid simulate system1.toml --experiment "
        "trapezoid:stroke=6.28,velocity=50,cycles=4,torque_noise=1e-3 --seed 7 --out b.csv\n"
        "  servoid simulate system1.toml --experiment trapezoid --mystery 3 --out m.csv");
    verb.callback([o] { run_simulate(*o); });
}

} // namespace servoid::cli
