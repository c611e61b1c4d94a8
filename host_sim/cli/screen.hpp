// What a stream is shown on: how wide, which characters, whether in colour.
#pragma once

#include <string>
#include <vector>

namespace servoid::cli {

struct Screen {
    bool terminal = false; // else a pipe or a file: nothing is wrapped, cut or coloured
    int columns = 80;
    bool utf8 = false;     // a terminal that says so; a pipe gets pictures in ASCII
    bool colour = false;   // a terminal that is not dumb, and NO_COLOR not set
    bool rewrites = false; // a line can be written again over itself: a terminal that is not dumb

    // Text as it goes out: on a terminal in lines that are not wider, further ones indented so
    // much more than the first, and in ASCII where it speaks nothing else. In a pipe as it is.
    std::vector<std::string> lines_of(const std::string& text, int indent = 2) const;
    // Text in a column of a table, blanks behind it: cut where it is too long for a terminal.
    std::string cell(const std::string& text, int width) const;
};

// Of a file descriptor, as it is now: a window changes its size.
Screen screen_of(int descriptor);

} // namespace servoid::cli
