// Small helpers on text: numbers as they stand in files, and names that a user mistyped.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace servoid {

// Without the spaces and tabs at both ends.
std::string_view trim(std::string_view text);

std::string lower_case(std::string_view text);

// Parts between separators, trimmed; "a,,b" has three.
std::vector<std::string> split(std::string_view text, char separator);

std::string join(const std::vector<std::string>& parts, std::string_view separator = ", ");

// A whole field as a finite decimal number ("+1.5", "1e-3"); nothing else passes, no hex, no nan.
std::optional<double> parse_number(std::string_view text);

// The shortest decimal that reads back as the same double.
std::string format_number(double value);

// Text from a file for a message: in quotes, control characters and bad bytes masked, cut when
// long.
std::string in_quotes(std::string_view text);

// The name that a typing mistake was probably meant to be, or "" where none is near.
std::string closest_name(std::string_view wrong, const std::vector<std::string>& names);

// `; did you mean "x"?` or the list of what is allowed.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

bool is_utf8(std::string_view text);

} // namespace servoid
