#include "cli/compare_output.hpp"
#include "cli/parameters.hpp"
#include "report/sparkline.hpp"

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

std::string bar(double share) {
    return fmt::format("{:<20}", std::string(size_t(std::lround(20 * std::min(1.0, share))), '#'));
}

std::string meaning_of(const Estimate& lag) {
    if (std::abs(lag.value) <= 3 * lag.std) return "of the torque: none that can be told from 0";
    return lag.value > 0 ? "the torque acts later than the model says: dead time, lag"
                         : "the torque acts earlier than recorded: a filter, no hold";
}

void print_summary(const Output& out, const Comparison& c) {
    out.line(fmt::format("torque error   {}   of {} rms, {:.3g} Hz band, {} samples, {:.4g} s",
                         out.bold(percent(c.torque_error)), c.torque_name, c.band_Hz, c.samples,
                         c.duration_s));
    out.line(fmt::format("band           {:.3g} Hz   {}", c.band_Hz, in_words(c.band_limited_by)));
    out.line(fmt::format("noise floor    {}   from {}", percent(c.floor.ratio),
                         c.floor.from_repetition
                             ? fmt::format("{} repetitions", c.floor.periods)
                             : std::string("the sensors' quantisation (nothing repeats)")));
    if (std::isfinite(c.floor.repeatable_share))
        out.line(fmt::format("repeatable     {}   of the residual's power: a better model could "
                             "explain it",
                             percent(c.floor.repeatable_share)));
    if (c.loop)
        out.line(fmt::format("closed loop    {}   of torque, {} of position",
                             percent(c.loop->torque_error), percent(c.loop->position_error)));
    if (c.lag_s)
        out.line(fmt::format("lag            {:.3g} ± {:.2g} ms   {}", 1e3 * c.lag_s->value,
                             1e3 * c.lag_s->std, meaning_of(*c.lag_s)));
}

bool by_value(const Regime& r) { return std::isfinite(r.mean_residual); }

void print_shares(const Output& out, const Comparison& c) {
    out.line("\nwhere it fails                              residual   samples");
    for (const Regime& r : c.where)
        if (!by_value(r))
            out.line(fmt::format("  {:<38} {:>10} {:>9}   {}", r.regime, percent(r.residual_share),
                                 percent(r.sample_share), bar(r.residual_share)));
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
    // Blocks are three bytes each, which a field width would count.
    const std::string space(8 - std::min<size_t>(8, bins.size()), ' ');
    out.line(fmt::format("  {:<13} {}{}  {:<24} {:>7} {:>11.3g}", most.group,
                         sparkline(means, full_scale, speaks_utf8()), space, range,
                         fmt::format("x {:.3g}", density(most)), most.mean_residual));
}

void print_means(const Output& out, const Comparison& c) {
    std::vector<std::vector<Regime>> groups;
    for (const Regime& r : c.where) {
        if (!by_value(r)) continue;
        if (groups.empty() || groups.back().front().group != r.group) groups.emplace_back();
        groups.back().push_back(r);
    }
    if (groups.empty()) return;
    out.line(fmt::format("\n{:<24}  {:<24} {:>7} {:>11}", "mean residual, low…high", "densest at",
                         "density", "mean, " + c.torque_unit));
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
    out.line(
        fmt::format("\n{:<22} {:>9} {:>9} {:>9}", "lines" + base, "residual", "torque", "noise"));
    for (const Kind& kind : kinds) {
        if (!std::isfinite(lines.residual.*kind.power)) continue;
        out.line(fmt::format("  {:<20} {:>9} {:>9} {:>9}  {}", kind.name,
                             percent(lines.residual.*kind.power), percent(lines.torque.*kind.power),
                             percent(lines.noise.*kind.power), kind.meaning));
    }
}

} // namespace

void print_comparison(const Output& out, const Comparison& c) {
    print_summary(out, c);
    print_shares(out, c);
    print_means(out, c);
    if (c.lines) print_lines(out, *c.lines);
}

} // namespace servoid::cli
