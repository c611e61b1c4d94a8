// Text as a terminal counts it: in columns, not in bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace servoid {

// Columns that UTF-8 text takes: none for escape sequences and combining marks, two for wide
// characters. A byte that is no UTF-8 counts as one.
int display_width(std::string_view text);

// At most so many columns, the last one "…" where something was cut. Text without escapes.
std::string shortened(std::string_view text, int columns);

// Blanks behind (or before) it up to so many columns.
std::string padded(std::string_view text, int columns);
std::string right_aligned(std::string_view text, int columns);

// Lines of at most so many columns, broken at blanks, further ones indented. A word that is longer
// is broken, behind a comma if there is one. Blanks within a line stay, those at its end do not.
std::vector<std::string> wrapped(std::string_view text, int columns, int indent);

// Words as one shell command over several lines, each but the last with a backslash at its end: it
// can be pasted. A word that is too long goes on at the beginning of the next line, unless it is in
// quotes: that one stays in one piece.
std::vector<std::string> wrapped_command(const std::vector<std::string>& words, int columns);

// Without characters beyond ASCII, for terminals that have none: "+-" for "±". May be longer.
std::string in_ascii(std::string_view text);

} // namespace servoid
