#include "answers/json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace servoid {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameter(double value, double std, const std::string& unit) {
    return {{"value", number(value)}, {"std", number(std)}, {"unit", unit}};
}

std::string percent(double ratio) {
    return std::isfinite(ratio) ? fmt::format("{:.3g} %", 100 * ratio) : "–";
}

} // namespace servoid
