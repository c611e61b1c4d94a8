// A share as a row of blocks.
#pragma once

#include <string>

namespace servoid {

// What a bar is drawn with: eighths of a character (▏▎▍▌▋▊▉█), or '#' where there is only ASCII.
struct BarStyle {
    int columns = 20;
    bool blocks = false;
};

// As long as the share, 0…1 of the columns, without blanks behind it. Of blocks, something can be
// seen of every share above 0.
std::string bar(double share, const BarStyle& style);

// A bar in three pieces, so that each can have a colour of its own: what lies before the mark, the
// mark (a thin line, whether the bar gets there or not), what lies behind it. Together always all
// the columns.
struct MarkedBar {
    std::string before, mark, behind;
    std::string text() const { return before + mark + behind; }
};
MarkedBar marked_bar(double share, double mark, const BarStyle& style);

} // namespace servoid
