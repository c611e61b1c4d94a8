// servoid effects: the catalogue.
#include "cli/app.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "effects/catalogue.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string name;
};

Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const EffectInfo& info) {
    Json parameters = Json::array();
    for (const ParameterInfo& p : info.parameters)
        parameters.push_back({{"key", p.key},
                              {"unit_rotary", unit_of(p.quantity, Motion::rotary)},
                              {"unit_linear", unit_of(p.quantity, Motion::linear)},
                              {"lower", bound(p.lower)},
                              {"upper", bound(p.upper)},
                              {"meaning", p.meaning}});
    Json out = {{"name", info.name},
                {"law", info.law},
                {"signature", info.signature},
                {"reference", info.reference},
                {"parameters", parameters},
                {"replaces", info.replaces},
                {"needs", info.needs},
                {"rotary_only", info.rotary_only},
                {"repeatable", info.repeatable}};
    if (!info.example.empty()) out["example"] = info.example;
    return out;
}

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

void print_one(const Output& out, const EffectInfo& info) {
    out.line(out.bold(info.name));
    out.line("  law        " + info.law);
    out.line("  signature  " + info.signature);
    out.line("  reference  " + info.reference);
    if (!info.replaces.empty()) out.line("  replaces   " + joined(info.replaces));
    if (!info.needs.empty()) out.line("  needs      " + joined(info.needs));
    for (const ParameterInfo& p : info.parameters)
        out.line(fmt::format("  {:<26} {:<12} {:<10} {}", p.key,
                             unit_of(p.quantity, Motion::rotary),
                             unit_of(p.quantity, Motion::linear), p.meaning));
    if (info.example.empty()) return;
    out.line("  example");
    for (const std::string& line : split(info.example, '\n'))
        out.line(line.empty() ? "" : "    " + line);
}

void run_effects(const Options& o) {
    if (!o.name.empty()) {
        const Effect* effect = find_effect(o.name);
        if (!effect) throw UsageError("no effect is called " + o.name + "; see: servoid effects");
        Json one = {{"schema", "servoid.effect/1"}};
        one.update(to_json(effect->info()));
        o.output.print_json(one);
        print_one(o.output, effect->info());
        return;
    }
    Json all = Json::array();
    for (const Effect* effect : catalogue()) {
        all.push_back(to_json(effect->info()));
        o.output.line(fmt::format("{:<22} {}", effect->info().name, effect->info().law));
    }
    o.output.print_json({{"schema", "servoid.effects/1"}, {"effects", all}});
}

} // namespace

void add_effects(CLI::App& app) {
    auto o = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand("effects", "the catalogue of physical effects");
    verb->add_option("name", o->name, "one effect: law, parameters, units, signature, reference");
    add_output_options(*verb, o->output);
    add_examples(*verb, "  servoid effects\n  servoid effects coulomb\n  servoid effects --json");
    verb->callback([o] { run_effects(*o); });
}

} // namespace servoid::cli
