// The mean of one thing over bins of another.
#pragma once

#include "answers/json.hpp"

#include <utility>
#include <vector>

namespace servoid {

using Point = std::pair<double, double>; // where it is, what it is there

struct MeanBin {
    double from = 0, to = 0;
    double mean = 0, std = 0;                // of the values in it
    double power_share = 0, count_share = 0; // of the values' power, of their number
    double middle() const { return 0.5 * (from + to); }
    double width() const { return to - from; }
};

// Bins of equal width between the 0.1th and 99.9th percentile of where the points are; those
// beyond go into the outermost. Bins with fewer than five points are left out. Empty where all
// points are at one place.
std::vector<MeanBin> mean_over(const std::vector<Point>& points, size_t bins);

// A part of the points, in their order: evenly taken, and the largest ones in any case.
std::vector<Point> thinned(const std::vector<Point>& points, size_t most);

// An array of six digits each, for plots; null for what is no number.
Json numbers(const std::vector<double>& values);

} // namespace servoid
