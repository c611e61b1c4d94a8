// servoid add: one more effect, fitted with everything else.
#include "answers/model_json.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/parameters.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "compare/compare.hpp"
#include "diagnose/add_effect.hpp"
#include "effects/custom_argument.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string effect, model, out;
};

Addition add_law(const Model& model, const EffectTerm& term,
                 const std::vector<PreparedMotion>& motions) {
    if (model.find(term.name))
        throw UsageError(term.name + " cannot be added: the model has it already");
    return add_term(model, term, motions);
}

void run_add(const Options& o) {
    std::optional<EffectTerm> law;
    if (is_custom(o.effect)) law = parse_custom(o.effect);
    const std::string name = law ? law->name : o.effect;
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model, o.output);
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const std::vector<std::string> warnings = check_capture(model, motions, o.output);
    const Addition a = law ? add_law(model, *law, motions) : add_effect(model, name, motions);
    const bool ampere = captures.front().torque_in_ampere;
    if (!o.out.empty()) write_file(o.out, format_model(a.after.model));
    Json json = {{"schema", "servoid.add/1"},
                 {"effect", name},
                 {"error_before", number(a.before.torque_error)},
                 {"error_after", number(a.after.torque_error)},
                 {"band_Hz", motions.front().band_Hz},
                 {"at_bound", a.after.at_bound},
                 {"warnings", warnings},
                 {"model", model_json(a.after.model)},
                 {"model_parameters", fitted_parameters(a.after, ampere)}};
    const std::vector<CaptureZero> zeros = zeros_of(a.after.homing, captures);
    add_homing(json, zeros);
    o.output.print_json(json);
    o.output.line(fmt::format(
        "torque error   {} -> {}   with {} ({:.3g} Hz band)", percent(a.before.torque_error),
        o.output.bold(percent(a.after.torque_error)), name, motions.front().band_Hz));
    print_parameters(o.output, a.after, ampere);
    print_homing(o.output, zeros);
    if (!o.out.empty()) o.output.line("wrote " + o.out);
}

} // namespace

void add_add(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "add", "add one effect, fit it and everything else again");
    verb.add_option(
            "effect", o->effect,
            "its name, see: servoid effects; or a law: custom.NAME=LAW[;PARAMETER=START...]")
        .required();
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    verb.add_option("--out", o->out, "where the larger model is written (- for stdout)");
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid add viscous model.toml run.csv --out better.toml\n"
                  "  servoid add coulomb better.toml run.csv --out better.toml --json\n"
                  "  servoid add 'custom.cubic=k*theta^3' model.toml run.csv --out m2.toml\n"
                  "  servoid add 'custom.s=k*tanh(v/vs);vs=0.1' model.toml run.csv");
    verb.callback([o] { run_add(*o); });
}

} // namespace servoid::cli
