// servoid compare: how far model and measurement are apart, and where.
#include "cli/app.hpp"
#include "cli/check_capture.hpp"
#include "cli/parameters.hpp"
#include "compare/compare.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    CaptureOptions captures;
    std::string model;
};

Json to_json(const Comparison& c, const std::vector<std::string>& warnings,
             const std::vector<CaptureZero>& zeros) {
    Json out = {{"schema", "servoid.compare/1"},
                {"torque_error", number(c.torque_error)},
                {"noise_floor", number(c.floor.ratio)},
                {"noise_floor_from", c.floor.from_repetition ? "repetition" : "quantisation"},
                {"repeatable_share", number(c.floor.repeatable_share)},
                {"loop", nullptr}};
    if (c.loop)
        out["loop"] = {{"torque_error", number(c.loop->torque_error)},
                       {"position_error", number(c.loop->position_error)}};
    out["where"] = Json::array();
    for (const Regime& r : c.where)
        out["where"].push_back({{"regime", r.regime},
                                {"group", r.group},
                                {"residual_share", number(r.residual_share)},
                                {"sample_share", number(r.sample_share)}});
    out["band_Hz"] = c.band_Hz;
    out["torque"] = c.torque_name;
    out["samples"] = c.samples;
    out["samples_used_share"] = c.samples_used_share;
    out["duration_s"] = c.duration_s;
    out["warnings"] = warnings;
    add_homing(out, zeros);
    return out;
}

std::string bar(double share) {
    return fmt::format("{:<20}", std::string(size_t(std::lround(20 * std::min(1.0, share))), '#'));
}

void print(const Output& out, const Comparison& c) {
    out.line(fmt::format("torque error   {}   of {} rms, {:.3g} Hz band, {} samples, {:.4g} s",
                         out.bold(percent(c.torque_error)), c.torque_name, c.band_Hz, c.samples,
                         c.duration_s));
    out.line(fmt::format("noise floor    {}   from {}", percent(c.floor.ratio),
                         c.floor.from_repetition
                             ? fmt::format("{} repetitions", c.floor.periods)
                             : std::string("the sensors' quantisation (nothing repeats)")));
    if (std::isfinite(c.floor.repeatable_share))
        out.line(fmt::format("repeatable     {}   of the residual's power: a better model could "
                             "explain it",
                             percent(c.floor.repeatable_share)));
    if (c.loop)
        out.line(fmt::format("closed loop    {}   of torque, {} of position",
                             percent(c.loop->torque_error), percent(c.loop->position_error)));
    out.line("\nwhere it fails                              residual   samples");
    for (const Regime& r : c.where)
        out.line(fmt::format("  {:<38} {:>10} {:>9}   {}", r.regime, percent(r.residual_share),
                             percent(r.sample_share), bar(r.residual_share)));
}

void run_compare(const Options& o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model);
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    std::vector<std::string> warnings = check_capture(model, motions, o.output);
    warn_of_zero(model, motions.front(), warnings, o.output);
    const Comparison c = compare(model, motions);
    const std::vector<CaptureZero> zeros = zeros_of(c.homing, captures);
    o.output.print_json(to_json(c, warnings, zeros));
    print(o.output, c);
    print_homing(o.output, zeros);
}

} // namespace

void add_compare(CLI::App& app) {
    auto o = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand("compare", "how far model and measurement are apart, and "
                                                   "where");
    verb->add_option("model", o->model, "model file (TOML)")->required();
    verb->add_option("captures", o->captures.files, "captures (.csv, .mat)")->required();
    add_capture_options(*verb, o->captures);
    add_output_options(*verb, o->output);
    add_examples(*verb, "  servoid compare model.toml run.csv\n"
                        "  servoid compare model.toml a.csv b.csv --band 40 --json\n"
                        "  servoid compare emps.toml DATA_EMPS.mat --map emps_map.toml");
    verb->callback([o] { run_compare(*o); });
}

} // namespace servoid::cli
