#include "compare/by_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kFewest = 0.005; // of the used samples: a mean of fewer says nothing

struct Variable {
    const char* group;
    Quantity quantity;
    size_t bins;
    const Vector& (*of)(const ResidualView&);
};

const Variable kVariables[] = {
    {"velocity", Quantity::velocity, 6,
     [](const ResidualView& c) -> const Vector& { return c.motion.velocity; }},
    {"position", Quantity::position, 8,
     [](const ResidualView& c) -> const Vector& { return c.motion.position; }},
    {"acceleration", Quantity::acceleration, 6,
     [](const ResidualView& c) -> const Vector& { return c.motion.acceleration; }},
    {"torque", Quantity::torque, 6,
     [](const ResidualView& c) -> const Vector& { return c.model_torque; }},
};

// The value and the residual of one instant.
using Point = std::pair<double, double>;

// The used instants of all captures; empty where one of them has not recorded the value.
std::vector<Point> points_of(const std::vector<ResidualView>& captures, const Variable& variable) {
    std::vector<Point> out;
    for (const ResidualView& c : captures) {
        const Vector& value = variable.of(c);
        if (value.size() != c.residual.size()) return {};
        for (Eigen::Index k = 0; k < value.size(); ++k)
            if (c.motion.used[size_t(k)]) out.emplace_back(value[k], c.residual[k]);
    }
    return out;
}

struct Bin {
    double from, to;
    double count = 0, sum = 0, power = 0; // of the residual
};

std::vector<Bin> bins_of(const std::vector<Point>& points, size_t count) {
    const auto [lowest, highest] = std::minmax_element(points.begin(), points.end());
    const double from = lowest->first, width = (highest->first - from) / double(count);
    if (!(width > 0)) return {};
    std::vector<Bin> out;
    for (size_t i = 0; i < count; ++i)
        out.push_back({from + double(i) * width, from + double(i + 1) * width});
    for (const auto& [value, residual] : points) {
        Bin& bin = out[std::min(count - 1, size_t((value - from) / width))];
        bin.count += 1, bin.sum += residual, bin.power += residual * residual;
    }
    return out;
}

void join_with_next(std::vector<Bin>& bins, size_t i) {
    const Bin next = bins[i + 1];
    bins[i].to = next.to;
    bins[i].count += next.count, bins[i].sum += next.sum, bins[i].power += next.power;
    bins.erase(bins.begin() + long(i) + 1);
}

// The emptiest bin first, with the emptier one of its neighbours.
void join_sparse(std::vector<Bin>& bins, double least) {
    while (bins.size() > 1) {
        const auto emptiest = std::min_element(
            bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.count < b.count; });
        if (emptiest->count >= least) return;
        const auto i = size_t(emptiest - bins.begin());
        const bool with_next =
            i == 0 || (i + 1 < bins.size() && bins[i + 1].count < bins[i - 1].count);
        join_with_next(bins, with_next ? i : i - 1);
    }
}

// "-49…-33 rad/s": edges to two digits of the width of the whole, so that neighbours differ.
std::string name_of(const Bin& bin, double width, const std::string& group,
                    const std::string& unit) {
    const int decimals = std::clamp(1 - int(std::floor(std::log10(width))), 0, 12);
    const auto edge = [&](double value) {
        const double unit_of_last = std::pow(10, -decimals);
        return std::abs(value) < unit_of_last / 2 ? 0.0 : value; // no "-0.0"
    };
    return fmt::format("{} {:.{}f}…{:.{}f} {}", group, edge(bin.from), decimals, edge(bin.to),
                       decimals, unit);
}

void add_group(const std::vector<ResidualView>& captures, const Variable& variable,
               std::vector<Regime>& out) {
    const std::vector<Point> points = points_of(captures, variable);
    if (points.empty()) return;
    std::vector<Bin> bins = bins_of(points, variable.bins);
    if (bins.empty()) return;
    const double width = bins.front().to - bins.front().from;
    join_sparse(bins, kFewest * double(points.size()));
    double power = 0;
    for (const Bin& bin : bins)
        power += bin.power;
    const PreparedMotion& m = captures.front().motion;
    const std::string unit = unit_of(variable.quantity, m.motion.kind, m.capture->torque_in_ampere);
    for (const Bin& bin : bins)
        out.push_back({variable.group, name_of(bin, width, variable.group, unit),
                       power > 0 ? bin.power / power : 0, bin.count / double(points.size()),
                       bin.from, bin.to, bin.sum / bin.count});
}

} // namespace

std::vector<Regime> where_by_value(const std::vector<ResidualView>& captures) {
    std::vector<Regime> out;
    for (const Variable& variable : kVariables)
        add_group(captures, variable, out);
    return out;
}

} // namespace servoid
