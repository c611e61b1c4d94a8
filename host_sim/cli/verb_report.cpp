// servoid report: the whole story of a model and its captures as one page.
#include "answers/diagnose_json.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/diagnose_output.hpp"
#include "cli/next_commands.hpp"
#include "cli/progress.hpp"
#include "common/file.hpp"
#include "page/page.hpp"
#include "story/story.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <set>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model, out;
    std::vector<std::string> validate;
    bool no_refine = false;
};

std::string command_of(const Options& o) {
    std::string out = "servoid report " + shell_word(o.model);
    for (const std::string& file : o.captures.files)
        out += " " + shell_word(file);
    for (size_t i = 0; i < o.validate.size(); ++i)
        out += (i ? " " : " --validate ") + shell_word(o.validate[i]);
    out += options_of(o.captures);
    if (o.no_refine) out += " --no-refine";
    return out + " --out " + shell_word(o.out);
}

Provenance provenance_of(const Options& o) {
    Provenance out;
    std::vector<std::string> files = {o.model};
    files.insert(files.end(), o.captures.files.begin(), o.captures.files.end());
    files.insert(files.end(), o.validate.begin(), o.validate.end());
    if (!o.captures.map.empty()) files.push_back(o.captures.map);
    std::set<std::string> seen;
    for (const std::string& file : files)
        if (seen.insert(file).second) out.files.push_back(source_file(file));
    out.commands = {command_of(o)};
    return out;
}

bool lacks_something(const Diagnosis& d) {
    return d.verdict != Verdict::adequate && d.verdict != Verdict::insufficient;
}

void answer(const Options& o, const Diagnosis& d, size_t bytes) {
    o.output.print_json({{"schema", "servoid.report/1"},
                         {"out", o.out},
                         {"bytes", bytes},
                         {"verdict", verdict_name(d.verdict)},
                         {"advice", d.advice}});
    o.output.line(fmt::format("{}   {}", badge(o.output, d.verdict), d.advice));
    o.output.line(fmt::format("wrote {} ({:.2f} MB)", o.out, 1e-6 * double(bytes)));
}

void run_report(const Options& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model, o.output);
    const std::vector<Capture> unseen = o.captures.read_files(o.validate, &model, o.output);
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const std::vector<PreparedMotion> validation = prepare_all(unseen, o.captures.motion());
    const Warnings warnings = check_capture(model, motions, o.output);
    const ProgressLine line(o.output);
    DiagnoseOptions options;
    options.progress = named("diagnose: ", line.progress());
    const Diagnosis d = diagnose(model, motions, options);
    std::optional<Refinement> r;
    options.progress = named("refine: ", line.progress());
    if (lacks_something(d) && !o.no_refine) r = refine(model, motions, validation, options);
    line.phase("drawing the page");
    const StoryInput input{model, motions,           d.before.model, &d.before,
                           &d,    r ? &*r : nullptr, warnings,       provenance_of(o)};
    const std::string page = report_page(make_story(input));
    write_file(o.out, page);
    line.clear();
    answer(o, d, page.size());
    refuse_if_insufficient(d);
}

} // namespace

void add_report(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "report", "the whole story as one page to look at and to mail");
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    verb.add_option("--out", o->out, "where the page is written (.html)").required();
    verb.add_option("--validate", o->validate, "captures that are never fitted");
    verb.add_flag("--no-refine", o->no_refine, "diagnose only: no ladder");
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid report model.toml run.csv --out report.html\n"
                  "  servoid report model.toml a.csv --validate b.csv --out report.html");
    verb.callback([o] { run_report(*o); });
}

} // namespace servoid::cli
