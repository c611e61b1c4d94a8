#include "report/bar.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

const char* const kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};

int eighths_of(double share, const BarStyle& style) {
    if (!(share > 0)) return 0;
    const double columns = std::min(1.0, share) * style.columns;
    if (!style.blocks) return 8 * int(std::lround(columns));
    return std::max(1, int(std::lround(8 * columns)));
}

// The column of the bar that is `at` from its left end, "" behind its right end.
std::string cell(int eighths, int at, bool blocks) {
    const int filled = std::clamp(eighths - 8 * at, 0, 8);
    if (blocks) return kEighths[filled];
    return filled > 0 ? "#" : "";
}

// The columns from one to another, with blanks where the bar has ended.
std::string cells(int eighths, int from, int to, bool blocks) {
    std::string out;
    for (int at = from; at < to; ++at) {
        const std::string one = cell(eighths, at, blocks);
        out += one.empty() ? " " : one;
    }
    return out;
}

} // namespace

std::string bar(double share, const BarStyle& style) {
    const int eighths = eighths_of(share, style);
    std::string out;
    for (int at = 0; at < style.columns; ++at)
        out += cell(eighths, at, style.blocks);
    return out;
}

MarkedBar marked_bar(double share, double mark, const BarStyle& style) {
    const int eighths = eighths_of(share, style);
    const int at =
        std::clamp(int(std::clamp(mark, 0.0, 1.0) * style.columns), 0, style.columns - 1);
    return {cells(eighths, 0, at, style.blocks), style.blocks ? "│" : "|",
            cells(eighths, at + 1, style.columns, style.blocks)};
}

} // namespace servoid
