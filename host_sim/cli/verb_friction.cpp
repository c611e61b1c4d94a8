// servoid friction: D, Tc, w from constant-speed runs, eqs. (8)–(14).
#include "cli/app.hpp"
#include "cli/parameters.hpp"
#include "identify/friction.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

struct Units {
    std::string viscous, torque, velocity;
};

Units units_of(const Capture& capture) {
    const Motion motion = capture.linear ? Motion::linear : Motion::rotary;
    const bool ampere = capture.torque_in_ampere;
    return {unit_of(Quantity::viscous, motion, ampere), unit_of(Quantity::torque, motion, ampere),
            unit_of(Quantity::velocity, motion, ampere)};
}

Json estimate(const Estimate& e, const std::string& unit) {
    return parameter(e.value, e.std, unit);
}

Json to_json(const FrictionResult& r, const Units& u) {
    Json out = {{"schema", "servoid.friction/1"},
                {"viscous", estimate(r.viscous, u.viscous)},
                {"coulomb", estimate(r.coulomb, u.torque)},
                {"constant_torque", estimate(r.constant_torque, u.torque)}};
    for (const auto& [name, side] : {std::pair{"forward", &r.forward}, {"reverse", &r.reverse}})
        out[name] = {{"viscous", estimate(side->viscous, u.viscous)},
                     {"offset", estimate(side->offset, u.torque)},
                     {"runs", side->runs}};
    out["runs"] = Json::array();
    for (const SpeedRun& run : r.runs) {
        Json one = {
            {"file", run.file},         {"velocity", run.velocity},    {"torque", run.torque},
            {"residual", run.residual}, {"spread", run.torque_spread}, {"samples", run.samples}};
        if (run.segment >= 0) one["segment"] = run.segment;
        out["runs"].push_back(one);
    }
    return out;
}

void print(const Output& out, const FrictionResult& r, const Units& u) {
    const auto row = [&](const char* name, const Estimate& e, const std::string& unit) {
        out.line(fmt::format("{:<24} {:>12.5g} ± {:<9.2g} {}", name, e.value, e.std, unit));
    };
    row("viscous friction", r.viscous, u.viscous);
    row("  forward", r.forward.viscous, u.viscous);
    row("  reverse", r.reverse.viscous, u.viscous);
    row("Coulomb friction", r.coulomb, u.torque);
    row("  forward (Tc + w)", r.forward.offset, u.torque);
    row("  reverse (Tc − w)", r.reverse.offset, u.torque);
    row("constant torque", r.constant_torque, u.torque);
    if (r.viscous.value < 0 || r.coulomb.value < 0)
        out.line("a negative friction is a sign that something else is missing (try Stribeck: "
                 "friction that falls with speed)");
    out.line(fmt::format("\n{:>12} {:>13} {:>13} {:>11}   run", u.velocity, u.torque, "residual",
                         "spread"));
    for (const SpeedRun& run : r.runs)
        out.line(fmt::format("{:>12.4g} {:>13.5g} {:>13.3g} {:>11.3g}   {}{}", run.velocity,
                             run.torque, run.residual, run.torque_spread,
                             std::filesystem::path(run.file).filename().string(),
                             run.segment >= 0 ? fmt::format(" segment {}", run.segment) : ""));
}

void run_friction(const Options& o) {
    std::optional<Model> model;
    if (!o.model.empty()) model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(model ? &*model : nullptr, o.output);
    std::vector<SpeedRun> runs;
    for (const Capture& capture : captures)
        for (const SpeedRun& run : find_runs(capture, o.captures.motion().input))
            runs.push_back(run);
    const FrictionResult result = fit_friction(std::move(runs));
    const Units units = units_of(captures.front());
    o.output.print_json(to_json(result, units));
    print(o.output, result, units);
}

} // namespace

void add_friction(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "friction",
                    "viscous and Coulomb friction and constant torque from constant-speed runs");
    verb.add_option("captures", o->captures.files,
                    "captures at constant speed, or with segments or plateaus of it")
        .required();
    verb.add_option("--model", o->model, "model file: scales for captures in A or per mille");
    verb.add_option("--map", o->captures.map, "TOML file that names foreign columns");
    verb.add_option("--input", o->captures.input, "ref or measured torque")
        .one_of({"ref", "measured"});
    add_output_options(verb, o->output);
    verb.examples("  servoid friction steady_*.csv\n"
                  "  servoid friction runs.csv --json");
    verb.callback([o] { run_friction(*o); });
}

} // namespace servoid::cli
