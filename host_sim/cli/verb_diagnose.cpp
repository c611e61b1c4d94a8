// servoid diagnose: which physical effect is missing?
#include "cli/add_command.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/parameters.hpp"
#include "common/file.hpp"
#include "diagnose/diagnose.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <iostream>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

Json parameters_of(const Candidate& c, const Diagnosis& d, bool ampere) {
    Json out = Json::object();
    for (const FittedParameter& p : c.parameters)
        out[p.name] = parameter(p.estimate.value, p.estimate.std,
                                unit_of(p.quantity, d.before.model.motion, ampere));
    return out;
}

Json candidate_json(const Candidate& c, const Diagnosis& d, bool ampere) {
    Json out = {{"effect", c.effect},
                {"probability", number(c.probability)},
                {"error_after", number(c.error_after)},
                {"validation_error_after", number(c.validation_error_after)},
                {"parameters", parameters_of(c, d, ampere)},
                {"signature", c.signature}};
    if (!c.note.empty()) out["note"] = c.note;
    return out;
}

Json outside_json(const Diagnosis& d) {
    return d.outside.empty() ? Json(nullptr) : Json(d.outside);
}

// A law that no catalogue names is of use only to who can add it.
void advise_to_add(Diagnosis& d, const std::string& model_path, const CaptureOptions& captures) {
    if (d.outside.empty()) return;
    d.advice += "; to add it: " + add_command(d.outside, d.before.model, model_path, captures);
}

Json next_json(const std::optional<NextExperiment>& next) {
    if (!next) return nullptr;
    return {{"experiment", next->experiment},
            {"separation", number(next->separation)},
            {"reason", next->reason}};
}

using Warnings = std::vector<std::string>;
using Zeros = std::vector<CaptureZero>;

// With the effect that was found, else of the model as it is.
const Homing& homing_of(const Diagnosis& d) {
    const bool found = d.verdict == Verdict::missing || d.verdict == Verdict::ambiguous;
    return found ? d.candidates.front().fit.homing : d.before.homing;
}

Json to_json(const Diagnosis& d, const Warnings& warnings, const Zeros& zeros, bool ampere) {
    Json out = {{"schema", "servoid.diagnose/1"},
                {"verdict", verdict_name(d.verdict)},
                {"error_before", number(d.error_before)},
                {"validation_error_before", number(d.validation_error_before)},
                {"noise_floor", number(d.noise_floor)},
                {"noise_floor_from", d.floor_from_repetition ? "repetition" : "quantisation"},
                {"band_Hz", d.band_Hz},
                {"candidates", Json::array()}};
    for (const Candidate& c : d.candidates)
        out["candidates"].push_back(candidate_json(c, d, ampere));
    out["probes"] = Json::array();
    for (const Probe& p : d.probes)
        out["probes"].push_back({{"variable", p.name}, {"explained", number(p.explained)}});
    out["model_parameters"] = fitted_parameters(d.before, ampere);
    add_homing(out, zeros);
    out["next_experiment"] = next_json(d.next);
    out["outside"] = outside_json(d);
    out["cannot_show"] = cannot_show_json(d.cannot_show);
    out["warnings"] = warnings;
    if (d.shortage) out["reason"] = d.shortage->why;
    out["advice"] = d.advice;
    return out;
}

// Of a capture that was refused before anything could be said.
Json no_diagnosis() {
    return {{"schema", "servoid.diagnose/1"}, {"verdict", nullptr},
            {"error_before", nullptr},        {"validation_error_before", nullptr},
            {"noise_floor", nullptr},         {"band_Hz", nullptr},
            {"candidates", Json::array()},    {"model_parameters", nullptr},
            {"next_experiment", nullptr},     {"outside", nullptr},
            {"cannot_show", Json::array()},   {"warnings", Json::array()}};
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

DiagnoseOptions with_progress(const Output& output) {
    DiagnoseOptions options;
    if (isatty(STDERR_FILENO) && !output.quiet)
        options.progress = [](const std::string& effect, double share) {
            std::cerr << fmt::format("\r{:3.0f} %  {:<24}", 100 * share, effect)
                      << (share > 0.95 ? "\r                                \r" : "") << std::flush;
        };
    return options;
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
    o.output.print_json(to_json(d, warnings, zeros, ampere));
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

Json to_json(const Refinement& r, const Warnings& warnings, const Zeros& zeros, bool ampere) {
    Json out = {{"schema", "servoid.refine/1"},
                {"verdict", verdict_name(r.verdict)},
                {"ladder", Json::array()}};
    for (const Rung& rung : r.ladder)
        out["ladder"].push_back({{"added", rung.added.empty() ? Json(nullptr) : Json(rung.added)},
                                 {"torque_error", number(rung.torque_error)},
                                 {"validation_error", number(rung.validation_error)}});
    out["removed"] = r.removed;
    out["model"] = model_json(r.result.model);
    out["model_parameters"] = fitted_parameters(r.result, ampere);
    add_homing(out, zeros);
    out["noise_floor"] = number(r.noise_floor);
    out["band_Hz"] = r.last.band_Hz;
    out["next_experiment"] = next_json(r.last.next);
    out["outside"] = outside_json(r.last);
    out["cannot_show"] = cannot_show_json(r.last.cannot_show);
    out["warnings"] = warnings;
    if (r.last.shortage) out["reason"] = r.last.shortage->why;
    out["advice"] = r.last.advice;
    return out;
}

Json no_refinement() {
    return {{"schema", "servoid.refine/1"},
            {"verdict", nullptr},
            {"ladder", Json::array()},
            {"removed", Json::array()},
            {"model", nullptr},
            {"model_parameters", nullptr},
            {"noise_floor", nullptr},
            {"band_Hz", nullptr},
            {"next_experiment", nullptr},
            {"outside", nullptr},
            {"cannot_show", Json::array()},
            {"warnings", Json::array()}};
}

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
    o.output.print_json(to_json(r, warnings, zeros, ampere));
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
