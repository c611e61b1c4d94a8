// servoid simulate: a capture of the simulated drive.
#include "cli/app.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "plant/simulate.hpp"

#include <fmt/format.h>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string model, experiment, out;
    unsigned long seed = 1;
};

void run_simulate(const Options& o) {
    if (o.out.ends_with(".log"))
        throw UsageError("--out: candump logs are not written yet; expected a .csv file or -");
    const Model model = read_model(o.model);
    const Capture capture = simulate(model, parse_experiment(o.experiment), o.seed);
    write_file(o.out, format_capture_csv(capture));
    o.output.print_json({{"schema", "servoid.simulate/1"},
                         {"out", o.out},
                         {"samples", capture.rows()},
                         {"sample_time_s", capture.sample_time_s},
                         {"seed", o.seed}});
    if (o.out != "-")
        o.output.line(fmt::format("wrote {}: {} samples, {:.4g} s", o.out, capture.rows(),
                                  double(capture.rows()) * capture.sample_time_s));
}

} // namespace

void add_simulate(CLI::App& app) {
    auto o = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand("simulate", "a capture of the simulated drive");
    verb->add_option("model", o->model, "model file (TOML) with a [controller]")->required();
    verb->add_option("--experiment", o->experiment,
                     "KIND:KEY=VALUE,... or a .toml file; kinds: sine, multisine, trapezoid, "
                     "constant_speed, speeds, staircase")
        ->required();
    verb->add_option("--seed", o->seed, "of the noise");
    verb->add_option("--out", o->out, "capture file (.csv), - for stdout")->required();
    add_output_options(*verb, o->output);
    add_examples(
        *verb, "  servoid simulate system1.toml --experiment sine:frequency_Hz=100 --out a.csv\n"
               "  (an experiment without a known key answers with the keys of its kind)\n"
               "  servoid simulate system1.toml --experiment "
               "trapezoid:stroke=6.28,velocity=50,cycles=4,torque_noise=1e-3 --seed 7 --out b.csv");
    verb->callback([o] { run_simulate(*o); });
}

} // namespace servoid::cli
