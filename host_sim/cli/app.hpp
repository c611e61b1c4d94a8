// The command line: one file per verb, each adds its own subcommand.
#pragma once

#include "answers/json.hpp"
#include "capture/capture.hpp"
#include "cli/verb.hpp"
#include "compare/motion.hpp"
#include "model/model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace servoid::cli {

// What every verb has.
struct Output {
    bool json = false;
    bool quiet = false;
    bool colour = false; // decided once: a terminal, and NO_COLOR not set

    // One JSON object on stdout, or nothing where text was asked for.
    void print_json(const Json& object) const;
    // A line of the answer on stdout (nothing under --json or --quiet).
    void line(const std::string& text) const;
    // A remark on stderr (nothing under --quiet).
    void note(const std::string& text) const;
    std::string bold(const std::string& text) const;
    std::string dim(const std::string& text) const;
};

// A terminal that says it speaks UTF-8; a pipe or a file gets pictures in ASCII.
bool speaks_utf8();

// Options of every verb that reads captures.
struct CaptureOptions {
    std::vector<std::string> files;
    std::string map;
    std::optional<double> band_Hz;
    std::string input; // "", "ref", "measured"

    std::vector<Capture> read(const Model* model) const;
    std::vector<Capture> read_files(const std::vector<std::string>& paths,
                                    const Model* model) const;
    MotionOptions motion() const;
};

// Adds --json and --quiet; colour is found out.
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
