#include "cli/app.hpp"

#include "can/bus_log.hpp"
#include "cli/progress.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "report/wide_text.hpp"
#include "servoid/sid_version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <iostream>
#include <limits>

namespace servoid::cli {

namespace {

// Where stderr is no terminal as it is; else in lines of its width.
void print_on_stderr(const std::string& text) {
    for (const std::string& one : screen_of(STDERR_FILENO).lines_of(text))
        std::cerr << one << '\n';
}

} // namespace

void Output::print_json(const Json& object) const {
    if (json) std::cout << object.dump(2) << '\n' << std::flush;
}

void Output::line(const std::string& text, int indent) const {
    if (json || quiet) return;
    for (const std::string& one : screen.lines_of(text, indent))
        std::cout << one << '\n';
}

void Output::note(const std::string& text) const {
    if (!quiet) print_on_stderr(text);
}

void Output::command(const std::vector<std::string>& words) const {
    if (json || quiet) return;
    const int columns = screen.terminal ? screen.columns : std::numeric_limits<int>::max();
    for (const std::string& one : wrapped_command(words, columns))
        std::cout << one << '\n';
}

std::string Output::paint(Tone tone, const std::string& text) const {
    if (!screen.colour || text.find_first_not_of(' ') == text.npos) return text;
    static constexpr const char* codes[] = {"1", "2", "7", "32", "33", "35", "31", "36"};
    return fmt::format("\033[{}m{}\033[0m", codes[size_t(tone)], text);
}

void add_output_options(const Verb& verb, Output& output) {
    verb.add_flag("--json", output.json, "one JSON object on stdout, nothing else there");
    verb.add_flag("--quiet", output.quiet, "no text but errors");
    output.screen = screen_of(STDOUT_FILENO);
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
                                const CaptureScales& scales, const Progress& progress) {
    std::optional<SignalMap> columns;
    if (!map.empty()) columns = read_signal_map(map);
    return {read_capture(path, scales, columns ? &*columns : nullptr, progress)};
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
                                                const Model* model, const Output& output) const {
    const CaptureScales scales = model ? scales_of(*model) : CaptureScales{};
    const ProgressLine line(output);
    std::vector<Capture> out;
    for (const std::string& path : paths)
        for (Capture& capture : lower_case(path).ends_with(".log")
                                    ? read_log(path, map, scales)
                                    : read_table(path, map, scales, line.progress())) {
            if (model) refuse_other_motion(capture, *model, path);
            out.push_back(std::move(capture));
        }
    return out;
}

std::vector<Capture> CaptureOptions::read(const Model* model, const Output& output) const {
    return read_files(files, model, output);
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
        print_on_stderr(std::string("servoid: ") + e.what());
        return int(e.code());
    } catch (const std::exception& e) {
        print_on_stderr(std::string("servoid: a defect of ours, please report it: ") + e.what());
        return int(ExitCode::defect);
    }
}

} // namespace servoid::cli
