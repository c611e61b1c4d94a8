// servoid compare: how far model and measurement are apart, and where.
#include "answers/compare_json.hpp"
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/compare_output.hpp"
#include "cli/over_time_text.hpp"
#include "cli/parameters.hpp"
#include "compare/compare.hpp"

#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

void run_compare(const Options& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model, o.output);
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    std::vector<std::string> warnings = check_capture(model, motions, o.output);
    warn_of_zero(model, motions.front(), warnings, o.output);
    const Comparison c = compare(model, motions);
    const std::vector<CaptureZero> zeros = zeros_of(c.homing, captures);
    Json json = compare_json(c, warnings);
    add_homing(json, zeros);
    o.output.print_json(json);
    std::vector<TimePart> parts;
    if (o.output.on_terminal())
        parts = residual_over_time(model, c.homing, motions, parts_on(o.output.screen));
    print_comparison(o.output, c, parts);
    print_homing(o.output, zeros);
}

} // namespace

void add_compare(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "compare", "how far model and measurement are apart, and where");
    verb.add_option("model", o->model, "model file (TOML)").required();
    verb.add_option("captures", o->captures.files, "captures (.csv, .mat, .log)").required();
    add_capture_options(verb, o->captures);
    add_output_options(verb, o->output);
    verb.examples("  servoid compare model.toml run.csv\n"
                  "  servoid compare model.toml a.csv b.csv --band 40 --json\n"
                  "  servoid compare emps.toml DATA_EMPS.mat --map emps_map.toml");
    verb.callback([o] { run_compare(*o); });
}

} // namespace servoid::cli
