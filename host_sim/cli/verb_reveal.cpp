// servoid reveal: what was hidden in a capture by simulate --mystery.
#include "cli/app.hpp"
#include "cli/parameters.hpp"
#include "effects/catalogue.hpp"
#include "mystery/secret.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string capture;
};

Json to_json(const Mystery& m, const EffectInfo& info) {
    Json parameters = Json::object();
    for (const ParameterInfo& p : info.parameters)
        parameters[p.key] = parameter(m.hidden.at(p.key), 0, unit_of(p.quantity, m.motion));
    return {{"schema", "servoid.reveal/1"},
            {"mystery", m.seed},
            {"effect", info.name},
            {"parameters", parameters},
            {"torque_share", m.share},
            {"band_Hz", m.band_Hz},
            {"law", info.law},
            {"signature", info.signature},
            {"replaces", info.replaces}};
}

void print(const Output& out, const Mystery& m, const EffectInfo& info) {
    out.line(fmt::format("{}   {}", out.bold(info.name), info.law));
    for (const ParameterInfo& p : info.parameters)
        out.line(fmt::format("  {:<26} {:>12.5g} {:<10} {}", p.key, m.hidden.at(p.key),
                             unit_of(p.quantity, m.motion), p.meaning));
    for (const std::string& name : info.replaces)
        out.line("  in place of " + name + ", where the model has it");
    out.line(
        fmt::format("{} of the torque in the {:.3g} Hz band, once inertia, viscous and Coulomb "
                    "friction and a constant torque are fitted without it",
                    percent(m.share), m.band_Hz));
    out.line("It shows as: " + info.signature);
}

void run_reveal(const Options& o) {
    const Mystery m = read_mystery(o.capture);
    const EffectInfo& info = find_effect(m.hidden.name)->info();
    o.output.print_json(to_json(m, info));
    print(o.output, m, info);
}

} // namespace

void add_reveal(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "reveal", "what simulate --mystery hid in a capture");
    verb.add_option("capture", o->capture, "the capture (.csv)").required();
    add_output_options(verb, o->output);
    verb.examples("  servoid simulate system1.toml --experiment trapezoid --mystery 3 --out "
                  "m.csv\n"
                  "  servoid reveal m.csv\n"
                  "  servoid reveal m.csv --json");
    verb.callback([o] { run_reveal(*o); });
}

} // namespace servoid::cli
