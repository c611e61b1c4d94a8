// servoid effects: the catalogue.
#include "cli/app.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "effects/catalogue.hpp"
#include "report/signature.hpp"
#include "report/text_plot.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <optional>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string name;
};

Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json picture_json(const Signature& s) {
    return {{"x", s.x},           {"y", s.y},           {"x_name", s.x_name},
            {"x_unit", s.x_unit}, {"y_name", s.y_name}, {"y_unit", s.y_unit}};
}

void print_picture(const Output& out, const Signature& s, const Picture& picture) {
    TextPlot plot;
    plot.braille = out.screen.utf8;
    if (out.screen.terminal) plot.columns = std::min(plot.columns, out.screen.columns - 12);
    plot.smallest_range = s.smallest_range;
    plot.x_label = s.x_name + ", " + s.x_unit;
    plot.y_label = s.y_name + ", " + s.y_unit;
    out.line("");
    for (const std::string& line : draw(s.x, s.y, plot))
        out.line(line);
    out.line(out.dim("a small motor with it, less a model without it, in " + picture.move));
}

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
    out.line("  law        " + info.law, 11);
    out.line("  signature  " + info.signature, 11);
    out.line("  reference  " + info.reference, 11);
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
        std::optional<Signature> signature; // of a law that is not written yet: none
        if (!effect->info().written) signature = signature_of(*effect);
        if (signature) one["picture"] = picture_json(*signature);
        o.output.print_json(one);
        print_one(o.output, effect->info());
        if (signature) print_picture(o.output, *signature, effect->info().picture);
        return;
    }
    Json all = Json::array();
    for (const Effect* effect : catalogue()) {
        all.push_back(to_json(effect->info()));
        o.output.line(fmt::format("{:<22} {}", effect->info().name, effect->info().law), 23);
    }
    o.output.print_json({{"schema", "servoid.effects/1"}, {"effects", all}});
}

} // namespace

void add_effects(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "effects", "the catalogue of physical effects");
    verb.add_option("name", o->name, "one effect: law, parameters, units, signature, reference");
    add_output_options(verb, o->output);
    verb.examples("  servoid effects\n  servoid effects coulomb\n  servoid effects --json");
    verb.callback([o] { run_effects(*o); });
}

} // namespace servoid::cli
