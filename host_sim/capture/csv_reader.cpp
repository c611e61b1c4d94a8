#include "capture/csv_reader.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace servoid {

namespace {

constexpr size_t longest_line = 64 * 1024;
constexpr size_t told_every = 16 * 1024; // rows
constexpr int unused = -1;               // a field that no signal asks for

// Digits of one printed number. Trailing zeros count: they were printed.
void note_printing(std::string_view number, Printing& printing) {
    int decimals = 0, significant = 0, exponent = 0;
    bool point = false;
    for (size_t i = 0; i < number.size(); ++i) {
        const char c = number[i];
        if (c == '.')
            point = true;
        else if (c >= '0' && c <= '9') {
            decimals += point;
            significant += c != '0' || significant > 0;
        } else if (c == 'e' || c == 'E') {
            const char* first = number.data() + i + 1;
            if (*first == '+') ++first;
            std::from_chars(first, number.data() + number.size(), exponent);
            break;
        }
    }
    if (significant == 0) return; // 0 says nothing about how 0.1 would have been printed
    printing.decimals = std::max(printing.decimals, decimals - exponent);
    printing.significant = std::max(printing.significant, significant);
}

class CsvReader {
  public:
    CsvReader(const std::string& text, const std::string& path, const SignalMap* map,
              const Progress& progress)
        : rest_(text), size_(text.size()), map_(map), progress_(progress) {
        table_.path = path;
        table_.metadata_path = path;
    }

    RawTable read() {
        check_encoding();
        read_head();
        if (map_) add_map_metadata();
        check_columns(table_);
        read_rows();
        return std::move(table_);
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw FileError(table_.path, line_, reason);
    }

    void check_encoding() {
        const auto starts = [&](std::string_view magic) { return rest_.starts_with(magic); };
        if (starts("\xff\xfe") || starts("\xfe\xff"))
            throw FileError(table_.path, 0, "is UTF-16 text; save it as UTF-8");
        if (starts("PK\x03\x04"))
            throw FileError(table_.path, 0, "is a zip archive or spreadsheet; export it as CSV");
        if (starts("MATLAB 5.0"))
            throw FileError(table_.path, 0,
                            "is a MATLAB file; name it .mat and give a map (--map)");
        if (starts("\xef\xbb\xbf")) rest_.remove_prefix(3);
        const auto nul = rest_.find('\0');
        if (nul == std::string_view::npos) return;
        line_ =
            1 + std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        fail("holds binary data (a NUL byte); expected CSV text");
    }

    // The next line without its end; false at the end of the file.
    bool next_line(std::string_view& line) {
        if (rest_.empty()) return false;
        ++line_;
        const void* newline = std::memchr(rest_.data(), '\n', rest_.size());
        const size_t length =
            newline ? static_cast<size_t>(static_cast<const char*>(newline) - rest_.data())
                    : rest_.size();
        line = rest_.substr(0, length);
        rest_.remove_prefix(std::min(length + 1, rest_.size()));
        if (line.size() > longest_line)
            fail("line of " + std::to_string(line.size()) + " bytes; expected at most " +
                 std::to_string(longest_line));
        if (line.ends_with('\r')) line.remove_suffix(1);
        return true;
    }

    void read_head() {
        std::string_view line;
        while (next_line(line)) {
            if (!is_utf8(line)) fail("is not UTF-8 text; save the file as UTF-8");
            const std::string_view text = trim(line);
            if (text.empty()) continue;
            if (text[0] == '#')
                read_metadata(text.substr(1));
            else
                return read_header(text);
        }
        line_ = 0;
        fail(table_.metadata.empty() ? "is empty; expected a header line and rows"
                                     : "has no header line; expected names such as time_s");
    }

    void read_metadata(std::string_view comment) {
        const auto equals = comment.find('=');
        if (equals == std::string_view::npos) return;
        const std::string key(trim(comment.substr(0, equals)));
        const std::string value(trim(comment.substr(equals + 1)));
        if (key.empty()) return;
        const auto [found, fresh] = table_.metadata.emplace(key, Metadata{value, line_});
        if (fresh || found->second.value == value) return;
        if (!is_meaningful_metadata(key))
            found->second.value += "; " + value; // prose: keep all
        else
            fail("metadata " + in_quotes(key) + " is given again with another value; line " +
                 std::to_string(found->second.line) + " has " + in_quotes(found->second.value));
    }

    void add_map_metadata() {
        for (const auto& [key, value] : map_->metadata)
            table_.metadata[key] = {value, 0};
    }

    void check_separator(std::string_view header) const {
        const bool comma = header.find(',') != std::string_view::npos;
        if (header.find('"') != std::string_view::npos && !map_)
            fail("the header is quoted; expected plain names, such as "
                 "time_s,torque_Nm,position_rad");
        if (!comma && header.find(';') != std::string_view::npos)
            fail(
                "fields are separated by semicolons; expected commas, and points as decimal signs");
        if (!comma && header.find('\t') != std::string_view::npos)
            fail("fields are separated by tabs; expected commas");
    }

    void read_header(std::string_view header) {
        table_.header_line = line_;
        check_separator(header);
        names_ = split(header, ',');
        if (parse_number(names_.front()))
            fail("no header line: the first line that is no comment starts with a number; expected "
                 "names such as time_s");
        if (map_)
            table_.columns = mapped_columns(*map_, names_, table_.path);
        else
            for (const auto& name : names_) {
                const ColumnMeaning* meaning = find_column(name);
                if (!meaning) fail(column_mistake(name));
                table_.columns.push_back({name, *meaning, {}, {}});
            }
        for (const auto& name : names_)
            target_.push_back(column_index(name));
    }

    // Without a map a field's column is at the same place, duplicates included.
    int column_index(const std::string& name) const {
        if (!map_) return static_cast<int>(target_.size());
        for (size_t i = 0; i < table_.columns.size(); ++i)
            if (table_.columns[i].name == name) return static_cast<int>(i);
        return unused;
    }

    void read_rows() {
        std::string_view line;
        long expected_line = 0;
        size_t rows = 0;
        while (next_line(line)) {
            const auto first = line.find_first_not_of(" \t");
            if (first == std::string_view::npos || line[first] == '#') continue;
            if (rows == 0) reserve(line.size() + 1);
            if (line_ != expected_line) table_.runs.emplace_back(rows, line_);
            expected_line = line_ + 1;
            read_row(line);
            if (++rows % told_every == 0) tell_progress();
        }
        check_row_count(rows);
    }

    void tell_progress() const {
        if (progress_)
            progress_("reading " + table_.path, 1 - double(rest_.size()) / double(size_));
    }

    void reserve(size_t row_size) {
        const size_t rows = rest_.size() / row_size + rest_.size() / row_size / 16 + 1;
        for (auto& column : table_.columns)
            column.values.reserve(rows);
    }

    void check_row_count(size_t rows) const {
        constexpr size_t fewest = 16;
        if (rows == 0) table_.fail_header("the header is not followed by any row");
        if (rows < fewest)
            throw FileError(table_.path, line_,
                            "only " + std::to_string(rows) + " rows; expected at least " +
                                std::to_string(fewest));
    }

    // The hot loop: every byte of a capture passes here once.
    void read_row(std::string_view line) {
        const char* at = line.data();
        const char* const end = at + line.size();
        for (size_t field = 0; field < target_.size(); ++field) {
            if (field > 0) {
                if (at == end || *at != ',') return row_mistake(line, field);
                ++at;
            }
            const int column = target_[field];
            if (column == unused) {
                at = std::find(at, end, ',');
                continue;
            }
            while (at != end && (*at == ' ' || *at == '\t'))
                ++at;
            const char* const first = at != end && *at == '+' ? at + 1 : at;
            double value = 0;
            const auto [stop, error] = std::from_chars(first, end, value);
            if (error != std::errc() || !std::isfinite(value) || (first != at && *first == '-'))
                return row_mistake(line, field);
            RawColumn& target = table_.columns[static_cast<size_t>(column)];
            note_printing({first, static_cast<size_t>(stop - first)}, target.printing);
            target.values.push_back(value);
            at = stop;
            while (at != end && (*at == ' ' || *at == '\t'))
                ++at;
        }
        if (at != end) row_mistake(line, target_.size());
    }

    // Looks at the row again, slowly, for the reason in words.
    [[noreturn]] void row_mistake(std::string_view line, size_t stopped_at) const {
        const auto fields = split(line, ',');
        if (fields == names_) fail("the header is repeated; expected a row of numbers");
        if (!is_utf8(line)) fail("holds bytes that are no UTF-8 text; expected a row of numbers");
        const size_t expected = names_.size();
        check_foreign_separator(line, fields.size());
        if (fields.size() != expected) fail(count_mistake(fields.size()));
        for (size_t i = 0; i < expected; ++i)
            if (target_[i] != unused) check_field(fields[i], names_[i]);
        const size_t i = std::min(stopped_at, expected - 1);
        fail("column " + in_quotes(names_[i]) + ": " + in_quotes(fields[i]) + " is not a number");
    }

    void check_foreign_separator(std::string_view line, size_t fields) const {
        if (fields == 1 && line.find(';') != std::string_view::npos)
            fail("fields are separated by semicolons; expected commas");
        if (line.find('"') != std::string_view::npos)
            fail("a field is quoted; expected plain numbers");
    }

    std::string count_mistake(size_t fields) const {
        const size_t expected = names_.size();
        std::string reason = std::to_string(fields) + " fields in this row; expected " +
                             std::to_string(expected) + ", as in the header";
        if (fields == 2 * expected)
            reason += " (decimal commas? use points; or two rows in one line)";
        else if (fields == 2 * expected - 1)
            reason += " (two rows in one line?)";
        else if (fields < expected && rest_.empty())
            reason += " (the file looks cut off)";
        return reason;
    }

    void check_field(const std::string& field, const std::string& name) const {
        if (parse_number(field)) return;
        const std::string what = "column " + in_quotes(name) + ": ";
        if (field.empty()) fail(what + "the field is empty; expected a number");
        const std::string lower = lower_case(field);
        if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos)
            fail(what + in_quotes(field) +
                 " is not a finite number; a capture must not have holes");
        fail(what + in_quotes(field) + " is not a number; expected a decimal such as -1.5e-3");
    }

    std::string_view rest_;
    size_t size_; // of all of it
    const SignalMap* map_;
    const Progress& progress_;
    RawTable table_;
    std::vector<std::string> names_; // of the header, in order
    std::vector<int> target_;        // field -> column of the table, or unused
    long line_ = 0;
};

} // namespace

RawTable read_csv(const std::string& text, const std::string& path, const SignalMap* map,
                  const Progress& progress) {
    return CsvReader(text, path, map, progress).read();
}

} // namespace servoid
