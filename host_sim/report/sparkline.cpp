#include "report/sparkline.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

// An odd number of levels: one of them is zero.
const std::vector<std::string> kBlocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇"};
const std::vector<std::string> kAscii = {"_", ".", "-", "'", "\""};
const std::vector<std::string> kHeights = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
const std::vector<std::string> kShades = {".", ":", "-", "=", "+", "*", "#", "@"};

} // namespace

std::string sparkline(const std::vector<double>& values, double full_scale, bool blocks) {
    const std::vector<std::string>& levels = blocks ? kBlocks : kAscii;
    const double middle = double(levels.size() - 1) / 2;
    std::string out;
    for (const double value : values) {
        const double share = full_scale > 0 ? std::clamp(value / full_scale, -1.0, 1.0) : 0;
        out += levels[size_t(std::lround(middle + middle * share))];
    }
    return out;
}

std::string skyline(const std::vector<double>& values, double full_scale, bool blocks) {
    const std::vector<std::string>& levels = blocks ? kHeights : kShades;
    std::string out;
    for (const double value : values) {
        const double share = full_scale > 0 ? std::clamp(value / full_scale, 0.0, 1.0) : 0;
        const auto level = size_t(std::min(share, 0.999) * double(levels.size()));
        out += std::isfinite(value) ? levels[level] : " ";
    }
    return out;
}

} // namespace servoid
