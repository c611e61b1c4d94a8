#include "cli/screen.hpp"

#include "common/text.hpp"
#include "report/wide_text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace servoid::cli {

namespace {

constexpr int kNarrowest = 20;

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

int columns_of(int descriptor) {
    winsize size{};
    if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return std::max<int>(kNarrowest, size.ws_col);
    const auto stated = parse_number(environment("COLUMNS"));
    return stated && *stated >= kNarrowest && *stated < 10000 ? int(*stated) : 80;
}

bool speaks_utf8() {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const std::string value = lower_case(environment(name));
        if (value.empty()) continue; // the first one that is set decides
        return value.find("utf-8") != std::string::npos || value.find("utf8") != std::string::npos;
    }
    return false;
}

} // namespace

std::vector<std::string> Screen::lines_of(const std::string& text, int indent) const {
    if (!terminal) return {text};
    const std::string spoken = utf8 ? text : in_ascii(text);
    std::vector<std::string> out;
    for (std::string_view rest = spoken;;) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const size_t blanks = std::min(line.find_first_not_of(' '), line.size());
        for (std::string& part : wrapped(line, columns, int(blanks) + indent))
            out.push_back(std::move(part));
        if (line.size() == rest.size()) return out;
        rest.remove_prefix(line.size() + 1);
    }
}

std::string Screen::cell(const std::string& text, int width) const {
    if (!terminal) return padded(text, width);
    if (utf8) return padded(shortened(text, width), width);
    const std::string plain = in_ascii(text); // before it is measured: it gets longer
    if (display_width(plain) <= width) return padded(plain, width);
    return plain.substr(0, size_t(std::max(0, width - 1))) + "~";
}

Screen screen_of(int descriptor) {
    Screen out;
    if (!isatty(descriptor)) return out;
    const bool dumb = environment("TERM") == "dumb";
    out.terminal = true;
    out.columns = columns_of(descriptor);
    out.utf8 = speaks_utf8();
    out.colour = !dumb && environment("NO_COLOR").empty();
    out.rewrites = !dumb;
    return out;
}

} // namespace servoid::cli
