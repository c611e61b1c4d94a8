// servoid diagnose: which physical effect is missing?
#include "answers/diagnose_json.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/diagnose_output.hpp"
#include "cli/live_refinement.hpp"
#include "cli/parameters.hpp"
#include "cli/progress.hpp"
#include "common/file.hpp"
#include "diagnose/diagnose.hpp"

#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

void answer_diagnose(const Options& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model, o.output);
    const bool ampere = captures.front().torque_in_ampere;
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const Warnings warnings = check_capture(model, motions, o.output);
    const ProgressLine line(o.output);
    DiagnoseOptions options;
    options.progress = line.progress();
    Diagnosis d = diagnose(model, motions, options);
    line.clear();
    const NextCommands next{o.model, o.captures};
    if (o.output.on_terminal()) show_diagnosis(o.output, d, next, ampere);
    advise_to_add(d, next);
    const Zeros zeros = zeros_of(homing_of(d), captures);
    o.output.print_json(diagnosis_json(d, warnings, zeros, ampere));
    if (!o.output.on_terminal()) print_diagnosis(o.output, d, ampere);
    print_homing(o.output, zeros);
    refuse_if_insufficient(d);
}

void run_diagnose(const Options& o) {
    or_insufficient(o.output, no_diagnosis(), [&] { answer_diagnose(o); });
}

struct RefineOptions : Options {
    std::vector<std::string> validate;
    std::string out;
};

void answer_refine(const RefineOptions& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model, o.output);
    const std::vector<Capture> unseen = o.captures.read_files(o.validate, &model, o.output);
    const bool ampere = captures.front().torque_in_ampere;
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const Warnings warnings = check_capture(model, motions, o.output);
    const std::vector<PreparedMotion> validation = prepare_all(unseen, o.captures.motion());
    const NextCommands next{o.out.empty() || o.out == "-" ? "MODEL" : o.out, o.captures};
    Refinement r;
    {
        LiveRefinement live(o.output, motions);
        r = refine(model, motions, validation, live.options());
        live.show_end(r, next, ampere);
    }
    advise_to_add(r.last, next);
    if (!o.out.empty()) write_file(o.out, format_model(r.result.model));
    Zeros zeros = zeros_of(r.result.homing, captures);
    for (const CaptureZero& zero : zeros_of(r.validation_homing, unseen))
        zeros.push_back(zero);
    o.output.print_json(refinement_json(r, warnings, zeros, ampere));
    if (!o.output.on_terminal()) print_refinement(o.output, r, ampere);
    print_homing(o.output, zeros);
    if (!o.out.empty()) o.output.line("wrote " + o.out);
    refuse_if_insufficient(r.last);
}

void run_refine(const RefineOptions& o) {
    or_insufficient(o.output, no_refinement(), [&] { answer_refine(o); });
}

} // namespace

void add_diagnose(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "diagnose", "which physical effect is missing");
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid diagnose model.toml run.csv\n"
                  "  servoid diagnose model.toml a.csv b.csv --json");
    verb.callback([o] { run_diagnose(*o); });
}

void add_refine(CLI::App& app) {
    auto o = std::make_shared<RefineOptions>();
    const Verb verb(app, "refine", "diagnose and add until nothing more is justified");
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    verb.add_option("--validate", o->validate, "captures that are never fitted");
    verb.add_option("--out", o->out, "where the refined model is written (- for stdout)");
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid refine model.toml run.csv --out better.toml\n"
                  "  servoid refine model.toml a.csv --validate b.csv --json");
    verb.callback([o] { run_refine(*o); });
}

} // namespace servoid::cli
