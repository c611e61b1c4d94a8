// servoid identify: inertia of a captured periodic move, by the firmware core.
#include "cli/app.hpp"
#include "cli/parameters.hpp"
#include "common/error.hpp"
#include "effects/effect.hpp"
#include "identify/identify.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model, method = "cubic";
    std::vector<double> frequencies, window;
};

sid_bin_method_t method_of(const std::string& name) {
    if (name == "dft") return SID_BIN_PLAIN_DFT;
    if (name == "constant") return SID_BIN_CONSTANT;
    if (name == "linear") return SID_BIN_LINEAR;
    if (name == "quadratic") return SID_BIN_QUADRATIC;
    return SID_BIN_CUBIC;
}

Motion motion_of(const Capture& capture) {
    return capture.linear ? Motion::linear : Motion::rotary;
}

Json to_json(const Identification& one, const Capture& capture) {
    const Motion motion = motion_of(capture);
    const auto unit = [&](Quantity q) { return unit_of(q, motion, capture.torque_in_ampere); };
    return {{"inertia", parameter(one.inertia.value, one.inertia.std, unit(Quantity::inertia))},
            {"viscous", parameter(one.viscous.value, one.viscous.std, unit(Quantity::viscous))},
            {"constant_torque",
             parameter(one.constant_torque.value, one.constant_torque.std, unit(Quantity::torque))},
            {"position_amplitude", one.position_amplitude},
            {"torque_amplitude", one.torque_amplitude},
            {"frequency_Hz", one.frequency_Hz},
            {"window", {{"first_period", one.first_period}, {"last_period", one.last_period}}},
            {"coulomb_leak", one.coulomb_leak},
            {"status", one.reason == SID_OK ? "ok" : sid_reason_text(one.reason)}};
}

// "± 0.01", or why there is no such number.
std::string spread(double std) {
    return std::isfinite(std) ? fmt::format("± {:.2g}", std) : "(spread unknown: too few periods)";
}

void print(const Output& out, const Identification& one, const Capture& capture) {
    const Motion motion = motion_of(capture);
    const auto unit = [&](Quantity q) { return unit_of(q, motion, capture.torque_in_ampere); };
    out.line(fmt::format("inertia          {} {} {}",
                         out.bold(fmt::format("{:.5g}", one.inertia.value)),
                         spread(one.inertia.std), unit(Quantity::inertia)));
    out.line(fmt::format("viscous          {:.5g} {} {}", one.viscous.value,
                         spread(one.viscous.std), unit(Quantity::viscous)));
    out.line(fmt::format("constant torque  {:.5g} {} {}", one.constant_torque.value,
                         spread(one.constant_torque.std), unit(Quantity::torque)));
    out.line(fmt::format("at {:.5g} Hz: {:.4g} {} and {:.4g} {} of amplitude, periods {:.4g} to "
                         "{:.4g}",
                         one.frequency_Hz, one.position_amplitude, unit(Quantity::position),
                         one.torque_amplitude, unit(Quantity::torque), one.first_period,
                         one.last_period));
    if (one.coulomb_leak != 0)
        out.line(fmt::format("the model's Coulomb friction put {:.3g} {} on the inertia: taken out",
                             one.coulomb_leak, unit(Quantity::inertia)));
}

void run_identify(const Options& o) {
    std::optional<Model> model;
    if (!o.model.empty()) model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(model ? &*model : nullptr);
    IdentifyOptions options;
    options.frequencies_Hz = o.frequencies;
    options.method = method_of(o.method);
    options.input = o.captures.motion().input;
    options.model = model ? &*model : nullptr;
    if (o.window.size() == 2) options.first_period = o.window[0], options.last_period = o.window[1];
    std::vector<Identification> all;
    for (const Capture& capture : captures)
        for (const Identification& one : identify(capture, options))
            all.push_back(one);
    const Identification answer = combined(all);
    Json json = {{"schema", "servoid.identify/1"}};
    json.update(to_json(answer, captures.front()));
    if (all.size() > 1)
        for (const Identification& one : all)
            json["frequencies"].push_back(to_json(one, captures.front()));
    o.output.print_json(json);
    for (const Identification& one : all)
        print(o.output, one, captures.front());
    if (all.size() > 1)
        o.output.line(fmt::format("all together     {:.5g} ± {:.2g} {}", answer.inertia.value,
                                  answer.inertia.std,
                                  unit_of(Quantity::inertia, motion_of(captures.front()),
                                          captures.front().torque_in_ampere)));
}

} // namespace

void add_identify(CLI::App& app) {
    auto o = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand(
        "identify", "inertia, viscous friction and constant torque, by the firmware core itself");
    verb->add_option("captures", o->captures.files, "captures (.csv, .mat) of a periodic move")
        ->required();
    verb->add_option("--model", o->model,
                     "model file: its scales, and its Coulomb friction is taken out of the answer");
    verb->add_option("--frequency", o->frequencies, "Hz, one or more (else found)");
    verb->add_option("--window", o->window,
                     "FIRST LAST: periods after the start (else 8 10, or the last two there are)")
        ->expected(2);
    verb->add_option("--method", o->method,
                     "trend under the sine: cubic, quadratic, linear, constant, or plain dft")
        ->check(CLI::IsMember({"cubic", "quadratic", "linear", "constant", "dft"}));
    verb->add_option("--map", o->captures.map, "TOML file that names foreign columns");
    verb->add_option("--input", o->captures.input, "ref or measured torque")
        ->check(CLI::IsMember({"ref", "measured"}));
    add_output_options(*verb, o->output);
    add_examples(*verb, "  servoid identify sine.csv\n"
                        "  servoid identify sine.csv --frequency 100 --json\n"
                        "  servoid identify bench.csv --model motor.toml --window 2 10");
    verb->callback([o] { run_identify(*o); });
}

} // namespace servoid::cli
