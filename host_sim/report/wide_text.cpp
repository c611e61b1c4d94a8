#include "report/wide_text.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace servoid {

namespace {

constexpr int kIndent = 4; // of the further lines of a command

// One thing that a terminal does not split: a character with its marks' bytes, or an escape.
struct Glyph {
    std::string_view bytes;
    uint32_t code = 0; // 0: an escape sequence
    int columns = 0;
};

bool in_any(uint32_t code, const std::pair<uint32_t, uint32_t>* ranges, size_t count) {
    return std::any_of(ranges, ranges + count,
                       [&](const auto& r) { return code >= r.first && code <= r.second; });
}

int columns_of(uint32_t code) {
    static constexpr std::pair<uint32_t, uint32_t> marks[] = {
        {0x300, 0x36F}, {0x200B, 0x200F}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFEFF, 0xFEFF}};
    static constexpr std::pair<uint32_t, uint32_t> wide[] = {
        {0x1100, 0x115F}, {0x2E80, 0xA4CF}, {0xAC00, 0xD7A3},   {0xF900, 0xFAFF},
        {0xFE30, 0xFE6F}, {0xFF00, 0xFF60}, {0x1F300, 0x1FAFF}, {0x20000, 0x3FFFD}};
    if (in_any(code, marks, std::size(marks))) return 0;
    return in_any(code, wide, std::size(wide)) ? 2 : 1;
}

// "\033[" up to the letter that ends it.
size_t escape_length(std::string_view text) {
    if (text.size() < 2 || text[0] != '\033' || text[1] != '[') return 0;
    size_t end = 2;
    while (end < text.size() && (text[end] < '@' || text[end] > '~'))
        ++end;
    return std::min(end + 1, text.size());
}

// Of the first character; a byte that begins none stands for itself.
size_t character_length(std::string_view text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const size_t length = byte(0) < 0xC0   ? 1
                          : byte(0) < 0xE0 ? 2
                          : byte(0) < 0xF0 ? 3
                          : byte(0) < 0xF8 ? 4
                                           : 1;
    if (length > text.size()) return 1;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0U) != 0x80) return 1;
    return length;
}

Glyph first_glyph(std::string_view text) {
    if (const size_t escape = escape_length(text)) return {text.substr(0, escape), 0, 0};
    const auto lead = static_cast<unsigned char>(text[0]);
    const size_t length = character_length(text);
    uint32_t code = length == 1 ? lead : lead & (0x7FU >> length);
    for (size_t i = 1; i < length; ++i)
        code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
    return {text.substr(0, length), code, columns_of(code)};
}

// Calls take(glyph) for one after the other, until it says false; what is left then.
template <class Take> std::string_view each_glyph(std::string_view text, const Take& take) {
    while (!text.empty()) {
        const Glyph glyph = first_glyph(text);
        if (!take(glyph)) break;
        text.remove_prefix(glyph.bytes.size());
    }
    return text;
}

// The most that goes into so many columns, at least one glyph.
size_t fitting(std::string_view text, int columns) {
    int used = 0;
    const std::string_view rest = each_glyph(text, [&](const Glyph& glyph) {
        if (used > 0 && used + glyph.columns > columns) return false;
        used += glyph.columns;
        return true;
    });
    return text.size() - rest.size();
}

std::string_view without_end(std::string_view text) {
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

// Where a word that is too long is broken: behind a comma in its second half, else anywhere.
size_t broken_word(std::string_view text, int columns) {
    const size_t most = fitting(text, columns);
    const size_t comma = text.rfind(',', most - 1);
    return comma != text.npos && comma > most / 2 ? comma + 1 : most;
}

// How much of a text goes into one line: all of it, up to a blank, or a part of its first word.
size_t line_length(std::string_view text, int columns) {
    if (display_width(text) <= columns) return text.size();
    const size_t most = fitting(text, columns);
    const size_t blank = most < text.size() && text[most] == ' ' ? most : text.rfind(' ', most);
    const bool breaks = blank != text.npos && text.find_first_not_of(' ') < blank;
    return breaks ? blank : broken_word(text, columns);
}

const char* ascii_of(uint32_t code) {
    static constexpr std::pair<uint32_t, const char*> table[] = {
        {0xB1, "+-"},     {0xB7, "*"},      {0xB2, "^2"},      {0xB3, "^3"},     {0xB0, " deg"},
        {0xB5, "u"},      {0xD7, "x"},      {0xF7, "/"},       {0x2026, "..."},  {0x2013, "-"},
        {0x2212, "-"},    {0x2192, "->"},   {0x3B1, "alpha"},  {0x3B2, "beta"},  {0x3B4, "delta"},
        {0x3B8, "theta"}, {0x3BA, "kappa"}, {0x3BB, "lambda"}, {0x3C0, "pi"},    {0x3C3, "sigma"},
        {0x3C4, "tau"},   {0x3C6, "phi"},   {0x3C9, "omega"},  {0x3B6, "zeta"},  {0x394, "D"},
        {0x2264, "<="},   {0x2265, ">="},   {0x2016, "|"},     {0x221A, "sqrt"}, {0x2030, "o/oo"},
        {0x3BC, "u"}};
    for (const auto& [from, to] : table)
        if (from == code) return to;
    return "?";
}

} // namespace

int display_width(std::string_view text) {
    int out = 0;
    each_glyph(text, [&](const Glyph& glyph) {
        out += glyph.columns;
        return true;
    });
    return out;
}

std::string shortened(std::string_view text, int columns) {
    if (display_width(text) <= columns) return std::string(text);
    if (columns <= 0) return "";
    if (columns == 1) return "…";
    std::string out(text.substr(0, fitting(text, columns - 1)));
    while (out.ends_with(' ') || out.ends_with(','))
        out.pop_back();
    return out + "…";
}

std::string padded(std::string_view text, int columns) {
    return std::string(text) + std::string(size_t(std::max(0, columns - display_width(text))), ' ');
}

std::string right_aligned(std::string_view text, int columns) {
    return std::string(size_t(std::max(0, columns - display_width(text))), ' ') + std::string(text);
}

std::vector<std::string> wrapped(std::string_view text, int columns, int indent) {
    std::vector<std::string> out;
    const std::string space(size_t(std::clamp(indent, 0, columns / 2)), ' ');
    std::string_view rest = without_end(text);
    do {
        const std::string before = out.empty() ? "" : space;
        const size_t length = line_length(rest, columns - int(before.size()));
        out.push_back(before + std::string(without_end(rest.substr(0, length))));
        rest.remove_prefix(length);
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    } while (!rest.empty());
    return out;
}

std::vector<std::string> wrapped_command(const std::vector<std::string>& words, int columns) {
    std::vector<std::string> out = {""};
    for (const std::string& word : words) {
        const int room = columns - (&word == &words.back() ? 0 : 2); // " \\" may follow
        if (!out.back().empty() && display_width(out.back()) + 1 + display_width(word) > room) {
            out.back() += " \\";
            out.push_back(std::string(kIndent, ' ') + word);
        } else
            out.back() += (out.back().empty() ? "" : " ") + word;
        // Inside single quotes a backslash is only a backslash.
        while (display_width(out.back()) > room && word.find('\'') == word.npos) {
            const size_t most = broken_word(out.back(), std::min(room, columns - 1));
            const std::string rest = out.back().substr(most);
            out.back() = out.back().substr(0, most) + "\\";
            out.push_back(rest);
        }
    }
    return out;
}

std::string in_ascii(std::string_view text) {
    std::string out;
    each_glyph(text, [&](const Glyph& glyph) {
        if (glyph.code < 0x80)
            out += glyph.bytes;
        else if (glyph.columns > 0)
            out += ascii_of(glyph.code);
        return true;
    });
    return out;
}

} // namespace servoid
