#include "report/text_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace servoid {

namespace {

struct Range {
    double low = 0, high = 0;
    // Of 0…1 across the range to one of `count` cells.
    int cell(double value, int count) const {
        const double share = (value - low) / (high - low);
        return std::clamp(int(share * count), 0, count - 1);
    }
};

Range range_of(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high > *low ? Range{*low, *high} : Range{*low - 0.5, *high + 0.5};
}

// Zero belongs to it: a residual is read by its sign.
Range range_around_zero(const std::vector<double>& values, double smallest) {
    Range r = range_of(values);
    r.low = std::min(r.low, 0.0), r.high = std::max(r.high, 0.0);
    const double widen = std::max(0.0, smallest - (r.high - r.low)) / 2;
    return {r.low - widen, r.high + widen};
}

// Dots by character, `across` × `down` of them in each.
class Canvas {
  public:
    Canvas(const TextPlot& plot)
        : plot_(plot), across_(plot.braille ? 2 : 1), down_(plot.braille ? 4 : 3),
          cells_(size_t(plot.columns * plot.rows), 0) {}

    int width() const { return plot_.columns * across_; }
    int height() const { return plot_.rows * down_; }
    // From the lower left corner.
    void dot(int x, int y) {
        const int from_top = height() - 1 - y;
        const int bit = (from_top % down_) * across_ + x % across_;
        cells_[size_t(from_top / down_ * plot_.columns + x / across_)] |= uint8_t(1 << bit);
    }
    std::string row(int r, bool zero) const {
        std::string out;
        for (int c = 0; c < plot_.columns; ++c) {
            const uint8_t cell = cells_[size_t(r * plot_.columns + c)];
            if (cell == 0)
                out += zero ? (plot_.braille ? "┄" : "-") : " ";
            else
                out += plot_.braille ? braille(cell) : ascii(cell);
        }
        return out;
    }
    int row_of(int y) const { return (height() - 1 - y) / down_; }

  private:
    // U+2800 and its dots, which are numbered down the left column first.
    static std::string braille(uint8_t cell) {
        static constexpr int order[] = {0, 3, 1, 4, 2, 5, 6, 7};
        int code = 0;
        for (int i = 0; i < 8; ++i)
            if (cell & (1 << i)) code |= 1 << order[i];
        return {char(0xE2), char(0xA0 | (code >> 6)), char(0x80 | (code & 0x3F))};
    }
    // Upper, middle and lower third.
    static std::string ascii(uint8_t cell) {
        static constexpr char glyphs[] = {' ', '\'', '*', '*', '.', '|', '*', '|'};
        return std::string(1, glyphs[cell & 7]);
    }

    const TextPlot& plot_;
    int across_, down_;
    std::vector<uint8_t> cells_;
};

} // namespace

std::vector<std::string> draw(const std::vector<double>& x, const std::vector<double>& y,
                              const TextPlot& plot) {
    if (x.empty()) return {};
    const Range across = range_of(x), up = range_around_zero(y, plot.smallest_range);
    Canvas canvas(plot);
    for (size_t i = 0; i < x.size(); ++i)
        canvas.dot(across.cell(x[i], canvas.width()), up.cell(y[i], canvas.height()));
    const int zero = canvas.row_of(up.cell(0, canvas.height()));
    std::vector<std::string> out = {plot.y_label};
    for (int r = 0; r < plot.rows; ++r) {
        const std::string label = r == 0               ? fmt::format("{:.2g}", up.high)
                                  : r == plot.rows - 1 ? fmt::format("{:.2g}", up.low)
                                  : r == zero          ? "0"
                                                       : "";
        out.push_back(fmt::format("{:>9} |{}|", label, canvas.row(r, r == zero)));
    }
    const std::string left = fmt::format("{:.3g}", across.low);
    const std::string right = fmt::format("{:.3g}", across.high);
    const int space = plot.columns - int(left.size()) - int(right.size());
    out.push_back(fmt::format("{:>9}  {}{:^{}}{}", "", left, plot.x_label, space, right));
    return out;
}

} // namespace servoid
