#include "cli/next_commands.hpp"

#include "common/text.hpp"

#include <fmt/format.h>

namespace servoid::cli {

namespace {

std::string free_name(const Model& model) {
    std::string name = "cubic";
    for (int i = 2; model.find("custom." + name); ++i)
        name = fmt::format("cubic{}", i);
    return name;
}

// Words that name the model, the captures and how they are read.
void append_files(Command& command, const NextCommands& next, const std::string& further = "") {
    command.push_back(shell_word(next.model));
    for (const std::string& file : next.captures.files)
        command.push_back(shell_word(file));
    if (!further.empty()) command.push_back(further);
    const std::string options = options_of(next.captures);
    if (!options.empty()) command.push_back(options.substr(1));
}

Command add_of(const std::string& what, const std::string& out, const NextCommands& next) {
    Command command = {"servoid", "add", what};
    append_files(command, next);
    command.insert(command.end(), {"--out", out});
    return command;
}

} // namespace

std::string shell_word(const std::string& text) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "0123456789_-+=.,:/%@";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::string options_of(const CaptureOptions& captures) {
    std::string out;
    if (!captures.map.empty()) out += " --map " + shell_word(captures.map);
    if (captures.band_Hz) out += fmt::format(" --band {}", *captures.band_Hz);
    if (!captures.input.empty()) out += " --input " + captures.input;
    return out;
}

Command add_law_command(const std::string& law, const Model& model, const NextCommands& next) {
    const std::string name = free_name(model);
    return add_of(fmt::format("'custom.{}={}'", name, law), fmt::format("with_{}.toml", name),
                  next);
}

Command add_effect_command(const std::string& effect, const NextCommands& next) {
    return add_of(effect, "with_" + effect + ".toml", next);
}

std::vector<Command> record_commands(const NextExperiment& experiment, const NextCommands& next) {
    Command again = {"servoid", "diagnose"};
    append_files(again, next, "next.csv");
    return {{"servoid", "command", "--can", "can0", "move", shell_word(experiment.experiment),
             "--out", "next.csv"},
            again};
}

void advise_to_add(Diagnosis& d, const NextCommands& next) {
    if (d.outside.empty()) return;
    d.advice += "; to add it: " + join(add_law_command(d.outside, d.before.model, next), " ");
}

} // namespace servoid::cli
