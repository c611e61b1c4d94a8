#include "cli/progress.hpp"

#include "report/bar.hpp"
#include "report/wide_text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

namespace servoid::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kShown = 0.3;    // s; work that is done sooner needs no line
constexpr double kBetween = 0.05; // s between two lines: nobody reads faster

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string time_left(double seconds) {
    if (seconds < 99.5) return fmt::format("{:.0f} s left", std::ceil(seconds));
    return fmt::format("{:.0f} min left", seconds / 60);
}

// "reading a.csv  ███▌      35 %  2 s left"; a narrow terminal goes without the bar.
std::string with_share(const std::string& what, double share, double left, const Screen& screen) {
    const std::string numbers =
        fmt::format("{:3.0f} %  {}", 100 * share, padded(time_left(left), 11));
    const int room = screen.columns - 1 - display_width(numbers) - 2;
    const int bars = std::clamp(room - 30, 0, 20);
    const std::string name = padded(shortened(what, std::min(28, room - bars)), 28);
    if (bars < 4) return shortened(what, room) + "  " + numbers;
    return name + "  " + padded(bar(share, {bars, screen.utf8}), bars) + numbers;
}

} // namespace

// One piece of work after the other: each starts at a smaller share again.
struct ProgressLine::Pass {
    Clock::time_point begin = Clock::now(), shown_at{};
    std::string what;
    double share = 0;
    int width = 0; // of the line that stands there

    void write(const std::string& text, const Screen& screen) {
        const std::string line = screen.utf8 ? text : in_ascii(text);
        const std::string shown =
            line.substr(0, screen.utf8 ? line.npos : size_t(screen.columns - 1));
        const int old = width;
        width = display_width(shown);
        std::cerr << '\r' << padded(shown, old) << std::flush;
        shown_at = Clock::now();
    }

    // Without escapes: they are for colours.
    void clear() {
        if (width == 0) return;
        std::cerr << '\r' << std::string(size_t(width), ' ') << '\r' << std::flush;
        width = 0;
    }

    void show(const std::string& now, double done) {
        if (done < share) *this = Pass{Clock::now(), {}, now, done, width};
        const bool open = done >= 1 && share < 1; // what follows takes nobody knows how long
        what = now, share = done;
        const double seconds = seconds_since(begin);
        if (seconds < kShown || (!open && seconds_since(shown_at) < kBetween)) return;
        const Screen screen = screen_of(STDERR_FILENO);
        const double left = seconds * (1 - share) / std::max(share, 0.01);
        write(share >= 1 ? shortened(what + " …", screen.columns - 1)
                         : with_share(what, share, left, screen),
              screen);
    }
};

ProgressLine::ProgressLine(const Output& output) {
    const Screen screen = screen_of(STDERR_FILENO);
    if (screen.rewrites && !output.quiet && !output.json) pass_ = std::make_unique<Pass>();
}

ProgressLine::~ProgressLine() { clear(); }

Progress ProgressLine::progress() const {
    if (!pass_) return {};
    return [pass = pass_.get()](const std::string& what, double share) { pass->show(what, share); };
}

Progress named(const std::string& words, const Progress& progress) {
    if (!progress) return {};
    return [=](const std::string& what, double share) { progress(words + what, share); };
}

void ProgressLine::phase(const std::string& what) const {
    if (!pass_) return;
    const Screen screen = screen_of(STDERR_FILENO);
    pass_->write(shortened(what + " …", screen.columns - 1), screen);
}

void ProgressLine::clear() const {
    if (pass_) pass_->clear();
}

} // namespace servoid::cli
