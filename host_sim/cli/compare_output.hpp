// What `compare` found, as JSON and on the terminal.
#pragma once

#include "cli/app.hpp"
#include "compare/compare.hpp"

namespace servoid::cli {

Json compare_json(const Comparison& c, const std::vector<std::string>& warnings);
void print_comparison(const Output& out, const Comparison& c);

} // namespace servoid::cli
