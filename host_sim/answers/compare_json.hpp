// servoid.compare/1: how far model and measurement are apart, and where.
#pragma once

#include "answers/json.hpp"
#include "compare/compare.hpp"

namespace servoid {

Json compare_json(const Comparison& c, const std::vector<std::string>& warnings);

} // namespace servoid
