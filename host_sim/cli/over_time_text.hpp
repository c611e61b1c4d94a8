// The residual along the record as a row of blocks, for terminals.
#pragma once

#include "cli/app.hpp"
#include "compare/over_time.hpp"

namespace servoid::cli {

// As many parts as there is room for.
int parts_on(const Screen& screen);

// With its worst places, numbered. Nothing for no parts.
void print_over_time(const Output& out, const std::vector<TimePart>& parts,
                     const std::string& unit);

// Of two models, one below the other on one scale; the second also enlarged where that shows
// nothing of it.
void print_before_and_after(const Output& out, const std::vector<TimePart>& before,
                            const std::vector<TimePart>& after);

} // namespace servoid::cli
