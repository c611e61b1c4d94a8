// One printed line per figure that a test shows: `figure: WHAT = VALUE (asked: ...)`.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace servoid {

inline void figure(const std::string& what, const std::string& value, const std::string& asked) {
    fmt::print("figure: {} = {} (asked: {})\n", what, value, asked);
    std::fflush(stdout);
}

inline void figure(const std::string& what, double value, const std::string& unit,
                   const std::string& asked) {
    figure(what, fmt::format("{:.5g}{}{}", value, unit.empty() ? "" : " ", unit), asked);
}

} // namespace servoid
