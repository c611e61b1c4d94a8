#include "cli/app.hpp"

#include "can/bus_log.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "servoid/sid_version.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

namespace servoid::cli {

void Output::print_json(const Json& object) const {
    if (json) std::cout << object.dump(2) << '\n' << std::flush;
}

void Output::line(const std::string& text) const {
    if (!json && !quiet) std::cout << text << '\n';
}

void Output::note(const std::string& text) const {
    if (!quiet) std::cerr << text << '\n';
}

std::string Output::bold(const std::string& text) const {
    return colour ? "\033[1m" + text + "\033[0m" : text;
}

std::string Output::dim(const std::string& text) const {
    return colour ? "\033[2m" + text + "\033[0m" : text;
}

bool speaks_utf8() {
    if (!isatty(STDOUT_FILENO)) return false;
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const char* value = std::getenv(name);
        if (!value || !*value) continue; // the first one that is set decides
        const std::string lower = lower_case(value);
        return lower.find("utf-8") != std::string::npos || lower.find("utf8") != std::string::npos;
    }
    return false;
}

void add_output_options(const Verb& verb, Output& output) {
    verb.add_flag("--json", output.json, "one JSON object on stdout, nothing else there");
    verb.add_flag("--quiet", output.quiet, "no text but errors");
    const char* no_colour = std::getenv("NO_COLOR");
    output.colour = isatty(STDOUT_FILENO) && !(no_colour && *no_colour);
}

void add_capture_options(const Verb& verb, CaptureOptions& options) {
    verb.add_option("--map", options.map,
                    "TOML file that names foreign columns (needed for .mat files)");
    verb.add_option("--band", options.band_Hz,
                    "upper edge of the compared band, Hz (else chosen from the data)")
        .positive();
    verb.add_option("--input", options.input,
                    "the torque that acts on the axis where both were recorded: ref or measured")
        .one_of({"ref", "measured"});
}

namespace {

// Each stretch of a candump log without a gap is a capture of its own.
std::vector<Capture> read_log(const std::string& path, const std::string& map,
                              const CaptureScales& scales) {
    if (map.empty())
        throw UsageError(path + ": a candump log needs a map of its frames (--map FILE)");
    return can::read_candump(path, can::read_frame_map(map), scales).captures;
}

std::vector<Capture> read_table(const std::string& path, const std::string& map,
                                const CaptureScales& scales) {
    std::optional<SignalMap> columns;
    if (!map.empty()) columns = read_signal_map(map);
    return {read_capture(path, scales, columns ? &*columns : nullptr)};
}

void refuse_other_motion(const Capture& capture, const Model& model, const std::string& path) {
    if (capture.linear == (model.motion == Motion::linear)) return;
    throw FileError(path, 0,
                    capture.linear
                        ? "a linear axis (m, N), but the model's motion is \"rotary\""
                        : "a rotary axis (rad, N·m), but the model's motion is \"linear\"");
}

} // namespace

std::vector<Capture> CaptureOptions::read_files(const std::vector<std::string>& paths,
                                                const Model* model) const {
    const CaptureScales scales = model ? scales_of(*model) : CaptureScales{};
    std::vector<Capture> out;
    for (const std::string& path : paths)
        for (Capture& capture : lower_case(path).ends_with(".log")
                                    ? read_log(path, map, scales)
                                    : read_table(path, map, scales)) {
            if (model) refuse_other_motion(capture, *model, path);
            out.push_back(std::move(capture));
        }
    return out;
}

std::vector<Capture> CaptureOptions::read(const Model* model) const {
    return read_files(files, model);
}

MotionOptions CaptureOptions::motion() const {
    MotionOptions out;
    out.band_Hz = band_Hz;
    if (input == "ref") out.input = Input::reference;
    if (input == "measured") out.input = Input::measured;
    return out;
}

int run(int argc, char** argv) {
    CLI::App app{"servoid: the inertia of a servo axis from a tiny move, and the physics that a "
                 "model of it still lacks"};
    app.set_version_flag("--version", SID_VERSION_STRING);
    app.require_subcommand(1);
    app.footer("Every verb has --help with examples.");
    for (auto add : {add_simulate, add_identify, add_sweep, add_friction, add_compare, add_add,
                     add_effects, add_diagnose, add_refine, add_reveal, add_replay, add_drive,
                     add_command, add_report, add_studio})
        add(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : int(ExitCode::usage);
    } catch (const Error& e) {
        std::cerr << "servoid: " << e.what() << '\n';
        return int(e.code());
    } catch (const std::exception& e) {
        std::cerr << "servoid: a defect of ours, please report it: " << e.what() << '\n';
        return int(ExitCode::defect);
    }
}

} // namespace servoid::cli
