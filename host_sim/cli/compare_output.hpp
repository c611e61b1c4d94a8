// What `compare` found, on the terminal.
#pragma once

#include "cli/app.hpp"
#include "compare/compare.hpp"

namespace servoid::cli {

void print_comparison(const Output& out, const Comparison& c);

} // namespace servoid::cli
