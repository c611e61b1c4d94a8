// A recording as its file holds it: columns in the file's own units, before any meaning.
#pragma once

#include "capture/columns.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid {

// How finely a column is printed: the most decimals and the most significant digits seen.
struct Printing {
    int decimals = -400;
    int significant = 0;
    // Half of the last digit that a number of this size was printed with.
    double rounding(double magnitude) const;
};
constexpr Printing printed_as_double = {400, 16};
constexpr Printing printed_as_float = {400, 7};
constexpr Printing printed_as_integer = {0, 16};

struct RawColumn {
    std::string name; // as the file has it
    ColumnMeaning meaning;
    std::vector<double> values;
    Printing printing;
};

struct Metadata {
    std::string value;
    long line = 0; // 0: not from a line of the capture
};

// Whether a key changes how the capture is read; any other metadata is only kept.
bool is_meaningful_metadata(const std::string& key);

struct RawTable {
    std::string path;
    std::string metadata_path; // where metadata lines are counted: the capture, or its map
    long header_line = 0;      // 0: a file without lines
    std::map<std::string, Metadata> metadata;
    std::vector<RawColumn> columns;
    // First row of each run of rows that stand in successive lines, and the line of that row.
    std::vector<std::pair<size_t, long>> runs;

    size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
    const RawColumn* find(Signal signal) const;
    long line_of(size_t row) const; // 0 where the file has no lines

    // FileError at a row: by its line, or by its number where the file has no lines.
    [[noreturn]] void fail_row(size_t row, const std::string& reason) const;
    [[noreturn]] void fail_header(const std::string& reason) const;
    [[noreturn]] void fail_metadata(const std::string& key, const std::string& reason) const;

    // A positive number from the metadata under the first of these keys that is there, else 0.
    double metadata_number(const std::vector<std::string>& keys) const;
    std::string metadata_text(const std::string& key) const; // "" where it is not there
};

} // namespace servoid
