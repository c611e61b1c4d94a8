#include "cli/ladder.hpp"

#include "report/bar.hpp"
#include "report/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::cli {

namespace {

constexpr double kFloorAt = 0.1; // of the bars' length
constexpr double kLeast = 4;     // factor that a bar spans above the floor
constexpr double kMost = 1e4;    // the same: a simulated capture may have no noise at all
constexpr double kNear = 1.5;    // times the floor: nearly there
constexpr double kFar = 6;       // times the floor: a long way to go
constexpr int kLongestBar = 60;

} // namespace

Ladder::Ladder(const Output& out, double top, double noise_floor)
    : out_(out), floor_(std::max(noise_floor, top / kMost)) {
    const double above = std::log(std::max(kLeast, top / floor_));
    span_ = above / (1 - kFloorAt);
    low_ = std::log(floor_) - kFloorAt * span_;
}

Ladder::Columns Ladder::columns() const {
    const int all = out_.screen.columns;
    if (all < 56) return {all - 18, 8, 0, 0, 8};
    if (all < 76) return {22, 9, 9, 0, std::min(kLongestBar, all - 43)};
    return {24, 9, 9, 9, std::min(kLongestBar, all - 54)};
}

double Ladder::share_of(double error) const {
    return error > 0 ? std::clamp((std::log(error) - low_) / span_, 0.0, 1.0) : 0;
}

std::string Ladder::bar_of(double error, int columns) const {
    const MarkedBar b = marked_bar(share_of(error), share_of(floor_), {columns, out_.screen.utf8});
    const Tone tone = error > kFar * floor_    ? Tone::red
                      : error > kNear * floor_ ? Tone::yellow
                                               : Tone::green;
    return out_.paint(tone, b.before) + b.mark + out_.paint(tone, b.behind);
}

void Ladder::print_head() const {
    const Columns c = columns();
    std::string text = padded("torque error", c.name) + right_aligned("fitted", c.error);
    if (c.unseen > 0) text += right_aligned("unseen", c.unseen);
    if (c.factor > 0) text += right_aligned("gained", c.factor);
    const MarkedBar empty = marked_bar(0, share_of(floor_), {c.bar, out_.screen.utf8});
    const int room = c.bar - display_width(empty.before) - 2;
    const std::string floor = fmt::format("noise {}", percent(floor_));
    const std::string key = fmt::format("noise floor {} · log. scale", percent(floor_));
    text += "  " + empty.before + empty.mark + " ";
    out_.line(out_.dim(text + (room >= display_width(key)     ? key
                               : room >= display_width(floor) ? floor
                                                              : "")));
}

void Ladder::print(const Rung& rung) {
    const Columns c = columns();
    const std::string name = rung.added.empty() ? "as it was" : "+ " + rung.added;
    std::string text = out_.screen.cell(name, c.name);
    text += out_.bold(right_aligned(percent(rung.torque_error), c.error));
    if (c.unseen > 0) text += right_aligned(percent(rung.validation_error), c.unseen);
    if (c.factor > 0)
        text += right_aligned(
            rungs_ == 0 ? "" : fmt::format("÷ {:.3g}", last_error_ / rung.torque_error), c.factor);
    out_.line(text + "  " + bar_of(rung.torque_error, c.bar));
    last_error_ = rung.torque_error;
    ++rungs_;
}

} // namespace servoid::cli
