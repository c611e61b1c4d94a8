#include "compare/held.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

// Than the quickest of its neighbours, which a sample is added to: a passage is known to one. A
// turning point passes a way in at most 7.5 times what the third stretch beside it takes, so a slow
// one counts too; nothing is lost by that.
constexpr double kLonger = 6;
constexpr size_t kNeighbours = 3; // on each side

struct Stretch {
    Eigen::Index from, to; // samples, to exclusive
    double length() const { return double(to - from); }
};

// Cuts the record, one after another, into the longest stretches within the given way.
std::vector<Stretch> stretches(const Eigen::VectorXd& x, double within) {
    std::vector<Stretch> out;
    for (Eigen::Index i = 0; i < x.size();) {
        double low = x[i], high = x[i];
        Eigen::Index end = i + 1;
        for (; end < x.size(); ++end) {
            low = std::min(low, x[end]), high = std::max(high, x[end]);
            if (high - low > within) break;
        }
        out.push_back({i, end});
        i = end;
    }
    return out;
}

// The quickest passage of that way among the neighbours on one side; the record's ends are cut.
double quickest(const std::vector<Stretch>& all, size_t from, size_t to) {
    double out = INFINITY;
    for (size_t k = std::max<size_t>(from, 1); k < std::min(to, all.size() - 1); ++k)
        out = std::min(out, all[k].length());
    return out;
}

} // namespace

std::vector<Interval> held_intervals(const Eigen::VectorXd& position, double step_s, double within,
                                     double shortest_s) {
    std::vector<Interval> out;
    if (position.size() < 8) return out;
    const std::vector<Stretch> all = stretches(position, within);
    for (size_t k = 0; k < all.size(); ++k) {
        const double before = quickest(all, k > kNeighbours ? k - kNeighbours : 0, k);
        const double after = quickest(all, k + 1, k + 1 + kNeighbours);
        const double around = std::isfinite(before) && std::isfinite(after)
                                  ? std::max(before, after)
                                  : std::min(before, after);
        if (all[k].length() < kLonger * (around + 1) || all[k].length() * step_s < shortest_s)
            continue;
        out.push_back({double(all[k].from) * step_s, double(all[k].to - 1) * step_s});
    }
    return out;
}

HeldWeight::HeldWeight(const std::vector<Interval>& intervals, double margin_s, double ramp_s)
    : ramp_s_(ramp_s) {
    for (Interval i : intervals) {
        i.from_s -= margin_s, i.to_s += margin_s;
        if (!intervals_.empty() && i.from_s - intervals_.back().to_s < 2 * ramp_s)
            intervals_.back().to_s = i.to_s;
        else
            intervals_.push_back(i);
    }
}

double HeldWeight::at(double time_s) const {
    const auto after = std::lower_bound(intervals_.begin(), intervals_.end(), time_s - ramp_s_,
                                        [](const Interval& i, double t) { return i.to_s < t; });
    if (after == intervals_.end()) return 0;
    const double outside = std::max({0.0, after->from_s - time_s, time_s - after->to_s});
    const double u = std::min(1.0, outside / ramp_s_); // two derivatives vanish at both ends
    return 1 - u * u * u * (10 - u * (15 - 6 * u));
}

// Only where an interval reaches: a long record is mostly none.
Eigen::VectorXd HeldWeight::at(double start_s, double step_s, Eigen::Index count) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
    for (const Interval& held : intervals_) {
        const double first = std::floor((held.from_s - ramp_s_ - start_s) / step_s);
        const double last = std::ceil((held.to_s + ramp_s_ - start_s) / step_s);
        for (auto i = Eigen::Index(std::max(0.0, first)); i < count && double(i) <= last; ++i)
            out[i] = at(start_s + double(i) * step_s);
    }
    return out;
}

} // namespace servoid
