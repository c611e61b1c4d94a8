// Commands to go on with, ready to be pasted into a shell.
#pragma once

#include "cli/app.hpp"
#include "diagnose/diagnose.hpp"

namespace servoid::cli {

// As it is where a shell takes it as one word; else in single quotes.
std::string shell_word(const std::string& text);
// " --map FILE --band HZ --input ref", as far as they were said.
std::string options_of(const CaptureOptions& captures);

// Of what they are made: the model that they go on from, and the captures that were read.
struct NextCommands {
    std::string model;
    const CaptureOptions& captures;
};

// A command as its words, each as a shell takes it.
using Command = std::vector<std::string>;

// The `servoid add` that adds a law, under a name that the model does not have yet.
Command add_law_command(const std::string& law, const Model& model, const NextCommands& next);
// The `servoid add` that adds an effect of the catalogue.
Command add_effect_command(const std::string& effect, const NextCommands& next);
// Records the move that tells rivals apart on a drive on the bus, and asks again with it.
std::vector<Command> record_commands(const NextExperiment& experiment, const NextCommands& next);

// A law that no catalogue names is of use only to who can add it: how is said with the advice.
void advise_to_add(Diagnosis& d, const NextCommands& next);

} // namespace servoid::cli
