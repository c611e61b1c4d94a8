// What `compare` found, on the terminal.
#pragma once

#include "cli/app.hpp"
#include "compare/compare.hpp"
#include "compare/over_time.hpp"

namespace servoid::cli {

// parts: of the record, as a row of blocks; empty where nobody looks at it.
void print_comparison(const Output& out, const Comparison& c, const std::vector<TimePart>& parts);

} // namespace servoid::cli
