#include "cli/over_time_text.hpp"

#include "report/sparkline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::cli {

namespace {

constexpr int kMost = 60;
constexpr int kLabels = 10; // columns before the row
constexpr size_t kWorst = 3;
constexpr double kEnlarged = 3; // so much lower a row shows nothing but that it is low

std::vector<double> rms_values(const std::vector<TimePart>& parts) {
    std::vector<double> out;
    for (const TimePart& p : parts)
        out.push_back(p.rms);
    return out;
}

double highest_of(const std::vector<TimePart>& parts) {
    double out = 0;
    for (const TimePart& p : parts)
        if (std::isfinite(p.rms)) out = std::max(out, p.rms);
    return out;
}

std::string row_of(const Output& out, const std::vector<TimePart>& parts, double full_scale) {
    return out.paint(Tone::cyan, skyline(rms_values(parts), full_scale, out.screen.utf8));
}

// Digits below the row, where the worst places are.
std::string marks_below(size_t parts, const std::vector<size_t>& worst) {
    std::string out(parts, ' ');
    for (size_t i = 0; i < worst.size(); ++i)
        out[worst[i]] = char('1' + i);
    return out.substr(0, out.find_last_not_of(' ') + 1);
}

} // namespace

int parts_on(const Screen& screen) { return std::min(kMost, screen.columns - kLabels); }

void print_over_time(const Output& out, const std::vector<TimePart>& parts,
                     const std::string& unit) {
    if (parts.empty()) return;
    const double rms = rms_of(parts), highest = highest_of(parts);
    out.line("\nresidual over time" +
             out.dim(fmt::format(", rms 0…{:.3g} {} of each {:.3g} s", highest, unit,
                                 parts.front().to_s - parts.front().from_s)));
    out.line("  " + row_of(out, parts, highest));
    const std::vector<size_t> worst = worst_of(parts, kWorst);
    if (worst.empty()) return;
    out.line("  " + out.paint(Tone::yellow, marks_below(parts.size(), worst)));
    const bool several = parts.back().capture > 0;
    for (size_t i = 0; i < worst.size(); ++i) {
        const TimePart& p = parts[worst[i]];
        out.line(fmt::format("  {}  {:.4g}…{:.4g} s{}  x {:.2g}  {}",
                             out.paint(Tone::yellow, std::to_string(i + 1)), p.from_s, p.to_s,
                             several ? fmt::format(" of capture {}", p.capture + 1) : "",
                             p.rms / rms, p.regime),
                 5);
    }
}

void print_before_and_after(const Output& out, const std::vector<TimePart>& before,
                            const std::vector<TimePart>& after) {
    if (before.empty()) return;
    const double highest = std::max(highest_of(before), highest_of(after));
    const double own = highest_of(after);
    out.line("\nresidual over time");
    out.line("  before  " + row_of(out, before, highest));
    out.line("  after   " + row_of(out, after, highest));
    if (own > 0 && highest > kEnlarged * own)
        out.line(fmt::format("  {:<7} {}", fmt::format("x {:.3g}", highest / own),
                             row_of(out, after, own)));
}

} // namespace servoid::cli
