// Points as a picture of characters.
#pragma once

#include <string>
#include <vector>

namespace servoid {

struct TextPlot {
    int columns = 60, rows = 12;
    bool braille = false;      // 2 × 4 dots a character; else ASCII, 1 × 3
    double smallest_range = 0; // of y
    std::string x_label, y_label;
};

// The lines of the picture: y's label, the points in a frame with the ends of both axes and the
// zero line, x's label. Empty where there are no points.
std::vector<std::string> draw(const std::vector<double>& x, const std::vector<double>& y,
                              const TextPlot& plot);

} // namespace servoid
