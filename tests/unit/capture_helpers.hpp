// Captures from text in memory, for the tests of the capture reader.
#pragma once

#include "capture/assemble.hpp"
#include "capture/capture.hpp"
#include "capture/csv_reader.hpp"
#include "common/error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <string>

namespace servoid {

inline Capture read_text(const std::string& text, const CaptureScales& scales = {},
                         const SignalMap* map = nullptr) {
    return assemble(read_csv(text, "test.csv", map), scales);
}

inline std::string error_of_text(const std::string& text, const CaptureScales& scales = {}) {
    try {
        read_text(text, scales);
        return "";
    } catch (const FileError& error) {
        return error.what();
    }
}

// 40 rows of three columns at 1 ms: a cosine and a small sine.
inline std::string sine_csv(const std::string& header) {
    std::string text = header + "\n";
    for (int i = 0; i < 40; ++i)
        text += fmt::format("{:.3f},{:.4f},{:.6f}\n", i * 0.001, std::cos(0.2 * i),
                            0.05 * std::sin(0.2 * i));
    return text;
}

} // namespace servoid
