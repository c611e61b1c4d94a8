// The command line: one file per verb, each adds its own subcommand.
#pragma once

#include "answers/json.hpp"
#include "capture/capture.hpp"
#include "cli/screen.hpp"
#include "cli/verb.hpp"
#include "compare/motion.hpp"
#include "model/model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace servoid::cli {

enum class Tone { bold, dim, inverse, green, yellow, magenta, red, cyan };

// What every verb has.
struct Output {
    bool json = false;
    bool quiet = false;
    Screen screen; // what stdout is

    // One JSON object on stdout, or nothing where text was asked for.
    void print_json(const Json& object) const;
    // A line of the answer on stdout (nothing under --json or --quiet). Where it is too long for
    // the terminal, it goes on below, `indent` columns further in.
    void line(const std::string& text, int indent = 2) const;
    // A remark on stderr (nothing under --quiet).
    void note(const std::string& text) const;
    // A command to be pasted: where the terminal is narrow over several lines that a shell joins.
    void command(const std::vector<std::string>& words) const;
    // In colour where there is any.
    std::string paint(Tone tone, const std::string& text) const;
    std::string bold(const std::string& text) const { return paint(Tone::bold, text); }
    std::string dim(const std::string& text) const { return paint(Tone::dim, text); }
    // Whether text is looked at by somebody: pictures, colours, lines of the screen's width.
    bool on_terminal() const { return screen.terminal && !json && !quiet; }
};

// Options of every verb that reads captures.
struct CaptureOptions {
    std::vector<std::string> files;
    std::string map;
    std::optional<double> band_Hz;
    std::string input; // "", "ref", "measured"

    // With progress where the files are large.
    std::vector<Capture> read(const Model* model, const Output& output) const;
    std::vector<Capture> read_files(const std::vector<std::string>& paths, const Model* model,
                                    const Output& output) const;
    MotionOptions motion() const;
};

// Adds --json and --quiet; what stdout is, is found out.
void add_output_options(const Verb& verb, Output& output);
void add_capture_options(const Verb& verb, CaptureOptions& options);

// The verbs.
void add_simulate(CLI::App& app);
void add_identify(CLI::App& app);
void add_sweep(CLI::App& app);
void add_friction(CLI::App& app);
void add_compare(CLI::App& app);
void add_add(CLI::App& app);
void add_effects(CLI::App& app);
void add_diagnose(CLI::App& app);
void add_refine(CLI::App& app);
void add_reveal(CLI::App& app);
void add_replay(CLI::App& app);
void add_drive(CLI::App& app);
void add_command(CLI::App& app);
void add_report(CLI::App& app);
void add_studio(CLI::App& app);

// Parses, runs, prints the message of what went wrong on stderr; returns the exit code.
int run(int argc, char** argv);

} // namespace servoid::cli
