#include "cli/compare_output.hpp"
#include "cli/over_time_text.hpp"
#include "cli/parameters.hpp"
#include "report/bar.hpp"
#include "report/sparkline.hpp"
#include "report/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::cli {

namespace {

const char* in_words(BandLimit limit) {
    switch (limit) {
    case BandLimit::asked:
        return "as --band asks";
    case BandLimit::torque:
        return "twice the frequency below which 99.8 % of the torque's power lies";
    case BandLimit::excitation:
        return "four times what the reference excites";
    case BandLimit::repetition:
        return "as far up as torque comes back with every period";
    case BandLimit::noise:
        return "up to where the position's noise drowns the acceleration";
    case BandLimit::record:
        return "the narrowest that the record's length allows";
    case BandLimit::sample_rate:
        return "the widest that the sample rate allows";
    }
    return "";
}

constexpr int kLabels = 15;    // columns before what is said in the summary
constexpr double kDense = 1.5; // of its share of the samples: a regime to look at

std::string meaning_of(const Estimate& lag) {
    if (std::abs(lag.value) <= 3 * lag.std) return "of the torque: none that can be told from 0";
    return lag.value > 0 ? "the torque acts later than the model says: dead time, lag"
                         : "the torque acts earlier than recorded: a filter, no hold";
}

void print_summary(const Output& out, const Comparison& c) {
    out.line(fmt::format("torque error   {}   of {} rms, {:.3g} Hz band, {} samples, {:.4g} s",
                         out.bold(percent(c.torque_error)), c.torque_name, c.band_Hz, c.samples,
                         c.duration_s),
             kLabels);
    out.line(fmt::format("band           {:.3g} Hz   {}", c.band_Hz, in_words(c.band_limited_by)),
             kLabels);
    out.line(fmt::format("noise floor    {}   from {}", percent(c.floor.ratio),
                         c.floor.from_repetition
                             ? fmt::format("{} repetitions", c.floor.periods)
                             : std::string("the sensors' quantisation (nothing repeats)")),
             kLabels);
    if (std::isfinite(c.floor.repeatable_share))
        out.line(fmt::format("repeatable     {}   of the residual's power: a better model could "
                             "explain it",
                             percent(c.floor.repeatable_share)),
                 kLabels);
    if (c.loop)
        out.line(fmt::format("closed loop    {}   of torque, {} of position",
                             percent(c.loop->torque_error), percent(c.loop->position_error)),
                 kLabels);
    if (c.lag_s)
        out.line(fmt::format("lag            {:.3g} ± {:.2g} ms   {}", 1e3 * c.lag_s->value,
                             1e3 * c.lag_s->std, meaning_of(*c.lag_s)),
                 kLabels);
}

bool by_value(const Regime& r) { return std::isfinite(r.mean_residual); }

// Columns of the table of shares. In a pipe they are what they always were.
struct ShareColumns {
    int name = 38, residual = 10, samples = 9, bar = 20;
};

ShareColumns share_columns(const Screen& screen) {
    if (!screen.terminal) return {};
    if (screen.columns < 56) return {screen.columns - 22, 8, 0, 8};
    const int bar = std::clamp(screen.columns / 3 - 8, 10, 40);
    return {std::min(38, screen.columns - 24 - bar), 8, 9, bar};
}

std::string share_bar(const Output& out, const Regime& r, int columns) {
    const BarStyle style{columns, out.screen.utf8};
    if (!out.screen.terminal) return padded(bar(r.residual_share, style), columns);
    const MarkedBar b = marked_bar(r.residual_share, r.sample_share, style);
    const bool dense = r.residual_share > kDense * r.sample_share;
    const Tone tone = dense ? Tone::yellow : Tone::cyan;
    return out.paint(tone, b.before) + b.mark + out.paint(tone, b.behind);
}

std::string share_row(const Screen& screen, const std::string& name, const std::string& residual,
                      const std::string& samples) {
    const ShareColumns columns = share_columns(screen);
    const int width = columns.name + 2; // with the indent
    std::string out = screen.cell(name, width) + " " + right_aligned(residual, columns.residual);
    if (columns.samples > 0) out += " " + right_aligned(samples, columns.samples);
    return out;
}

void print_shares(const Output& out, const Comparison& c) {
    const ShareColumns columns = share_columns(out.screen);
    const char* key = !out.screen.terminal || columns.bar < 10 ? ""
                      : out.screen.utf8                        ? "   │ samples"
                                                               : "   | samples";
    out.line("\n" + share_row(out.screen, "where it fails", "residual", "samples") + key);
    for (const Regime& r : c.where)
        if (!by_value(r))
            out.line(share_row(out.screen, "  " + r.regime, percent(r.residual_share),
                               percent(r.sample_share)) +
                     "   " + share_bar(out, r, columns.bar));
}

// Which columns of the table of means there is room for.
struct MeanColumns {
    int range = 24;
    bool density = true;
};

MeanColumns mean_columns(const Screen& screen) {
    if (!screen.terminal || screen.columns >= 72) return {};
    return {screen.columns >= 58 ? screen.columns - 38 : 0, false};
}

std::string mean_row(const Screen& screen, const std::string& means, const std::string& range,
                     const std::string& density, const std::string& mean) {
    const MeanColumns columns = mean_columns(screen);
    std::string out = screen.cell(means, 24) + "  ";
    if (columns.range > 0) out += screen.cell(range, columns.range) + " ";
    if (columns.density) out += right_aligned(density, 7) + " ";
    return out + right_aligned(mean, 11);
}

// The bins of one group as a row of characters, and the one that holds most for its samples.
void print_group(const Output& out, const std::vector<Regime>& bins, double full_scale) {
    std::vector<double> means;
    for (const Regime& r : bins)
        means.push_back(r.mean_residual);
    const auto density = [](const Regime& r) { return r.residual_share / r.sample_share; };
    const Regime& most =
        *std::max_element(bins.begin(), bins.end(), [&](const Regime& a, const Regime& b) {
            return density(a) < density(b);
        });
    const std::string range = most.regime.substr(most.group.size() + 1);
    const std::string row = sparkline(means, full_scale, out.screen.utf8);
    out.line(mean_row(out.screen, fmt::format("  {:<13} {}", most.group, row), range,
                      fmt::format("x {:.3g}", density(most)),
                      fmt::format("{:.3g}", most.mean_residual)));
}

void print_means(const Output& out, const Comparison& c) {
    std::vector<std::vector<Regime>> groups;
    for (const Regime& r : c.where) {
        if (!by_value(r)) continue;
        if (groups.empty() || groups.back().front().group != r.group) groups.emplace_back();
        groups.back().push_back(r);
    }
    if (groups.empty()) return;
    out.line("\n" + mean_row(out.screen, "mean residual, low…high", "densest at", "density",
                             "mean, " + c.torque_unit));
    for (const std::vector<Regime>& bins : groups)
        print_group(out, bins, c.residual_rms);
}

void print_lines(const Output& out, const Lines& lines) {
    struct Kind {
        std::string name;
        const char* meaning;
        double LineKinds::*power;
        int count;
    };
    const LineCounts& n = lines.counts;
    const Kind kinds[] = {
        {fmt::format("{} excited", n.excited), "the model's numbers", &LineKinds::excited,
         n.excited},
        {fmt::format("{} odd, not excited", n.odd), "friction, saturation", &LineKinds::odd, n.odd},
        {fmt::format("{} even", n.even), "direction, place, gravity", &LineKinds::even, n.even}};
    const std::string base =
        std::isfinite(lines.base_Hz) ? fmt::format(" of {:.4g} Hz", lines.base_Hz) : "";
    const int room = out.screen.terminal ? out.screen.columns : 80;
    const auto row = [&](const std::string& name, const std::string& residual,
                         const std::string& torque, const std::string& noise) {
        const std::string cells = fmt::format("{:<22} {:>8} {:>8}", name, residual, torque);
        return room < 52 ? cells
                         : fmt::format("{:<22} {:>9} {:>9} {:>9}", name, residual, torque, noise);
    };
    out.line("\n" + row("lines" + base, "residual", "torque", "noise"));
    for (const Kind& kind : kinds) {
        if (!std::isfinite(lines.residual.*kind.power)) continue;
        out.line(row("  " + kind.name, percent(lines.residual.*kind.power),
                     percent(lines.torque.*kind.power), percent(lines.noise.*kind.power)) +
                 (room < 80 ? "" : std::string("  ") + kind.meaning));
    }
}

} // namespace

void print_comparison(const Output& out, const Comparison& c, const std::vector<TimePart>& parts) {
    print_summary(out, c);
    print_over_time(out, parts, c.torque_unit);
    print_shares(out, c);
    print_means(out, c);
    if (c.lines) print_lines(out, *c.lines);
}

} // namespace servoid::cli
