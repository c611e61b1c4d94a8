// servoid diagnose: which physical effect is missing?
#include "answers/diagnose_json.hpp"
#include "cli/add_command.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/parameters.hpp"
#include "cli/progress.hpp"
#include "common/file.hpp"
#include "diagnose/diagnose.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

// A law that no catalogue names is of use only to who can add it.
void advise_to_add(Diagnosis& d, const std::string& model_path, const CaptureOptions& captures) {
    if (d.outside.empty()) return;
    d.advice += "; to add it: " + add_command(d.outside, d.before.model, model_path, captures);
}

void print_best(const Output& out, const Diagnosis& d, bool ampere) {
    if (d.candidates.empty() || !d.candidates.front().sound) return;
    const Candidate& best = d.candidates.front();
    out.line(fmt::format("\n{}: {}", best.effect, best.signature));
    for (const FittedParameter& p : best.parameters)
        out.line(fmt::format("  {:<34} {:>12.5g} ± {:<9.2g} {}", p.name, p.estimate.value,
                             p.estimate.std, unit_of(p.quantity, d.before.model.motion, ampere)));
}

void print(const Output& out, const Diagnosis& d, bool ampere) {
    out.line(fmt::format("{}   torque error {}, noise floor {}, {:.3g} Hz band",
                         out.bold(verdict_name(d.verdict)), percent(d.error_before),
                         percent(d.noise_floor), d.band_Hz));
    out.line(d.advice);
    if (d.next) out.line(d.next->reason);
    out.line("");
    out.line(fmt::format("{:<22} {:>11} {:>9} {:>9}", "effect", "probability", "after", "unseen"));
    for (const Candidate& c : d.candidates) {
        if (!c.fitted) continue;
        out.line(fmt::format("{:<22} {:>11.3f} {:>9} {:>9}   {}", c.effect, c.probability,
                             percent(c.error_after), percent(c.validation_error_after), c.note));
    }
    print_best(out, d, ampere);
    print_cannot_show(out, d.cannot_show);
}

void answer_diagnose(const Options& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model);
    const bool ampere = captures.front().torque_in_ampere;
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const Warnings warnings = check_capture(model, motions, o.output);
    Diagnosis d = diagnose(model, motions, with_progress(o.output));
    advise_to_add(d, o.model, o.captures);
    const Zeros zeros = zeros_of(homing_of(d), captures);
    o.output.print_json(diagnosis_json(d, warnings, zeros, ampere));
    print(o.output, d, ampere);
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

void print(const Output& out, const Refinement& r, bool ampere) {
    const double top = r.ladder.front().torque_error;
    for (const Rung& rung : r.ladder) {
        const auto length = size_t(std::max(1.0, 40 * rung.torque_error / top));
        out.line(fmt::format(
            "{:<24} {:>8} {:>8}  {}", rung.added.empty() ? "as it was" : "+ " + rung.added,
            percent(rung.torque_error), percent(rung.validation_error), std::string(length, '#')));
    }
    for (const std::string& name : r.removed)
        out.line("- " + name + " (needless in the end)");
    out.line(fmt::format("{:<24} {:>8}\n", "noise floor", percent(r.noise_floor)));
    out.line(out.bold(verdict_name(r.verdict)) + "   " + r.last.advice);
    print_parameters(out, r.result, ampere);
    print_cannot_show(out, r.last.cannot_show);
}

void answer_refine(const RefineOptions& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model);
    const std::vector<Capture> unseen = o.captures.read_files(o.validate, &model);
    const bool ampere = captures.front().torque_in_ampere;
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const Warnings warnings = check_capture(model, motions, o.output);
    Refinement r =
        refine(model, motions, prepare_all(unseen, o.captures.motion()), with_progress(o.output));
    advise_to_add(r.last, o.out.empty() || o.out == "-" ? "MODEL" : o.out, o.captures);
    if (!o.out.empty()) write_file(o.out, format_model(r.result.model));
    Zeros zeros = zeros_of(r.result.homing, captures);
    for (const CaptureZero& zero : zeros_of(r.validation_homing, unseen))
        zeros.push_back(zero);
    o.output.print_json(refinement_json(r, warnings, zeros, ampere));
    print(o.output, r, ampere);
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
