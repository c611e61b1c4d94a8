// What `diagnose` and `refine` found: as text for pipes, and as a picture for terminals.
#pragma once

#include "cli/app.hpp"
#include "cli/next_commands.hpp"
#include "diagnose/diagnose.hpp"

namespace servoid::cli {

// In a pipe: one line per candidate or rung, of fixed columns.
void print_diagnosis(const Output& out, const Diagnosis& d, bool ampere);
void print_refinement(const Output& out, const Refinement& r, bool ampere);

// The verdict as a badge, always with its word.
std::string badge(const Output& out, Verdict verdict);

// On a terminal: badge, candidates with bars, the best one's parameters, what to do next.
void show_diagnosis(const Output& out, const Diagnosis& d, const NextCommands& next, bool ampere);

// Commands that go on from it: the effect or law to add, the move to record.
void show_next(const Output& out, const Diagnosis& d, const NextCommands& next);

} // namespace servoid::cli
