// Numbers as every answer in JSON shows them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace servoid {

using Json = nlohmann::ordered_json;

// A number that is not finite becomes null.
Json number(double value);
// {"value": …, "std": …, "unit": …}.
Json parameter(double value, double std, const std::string& unit);

std::string percent(double ratio); // three significant digits and a percent sign

} // namespace servoid
