// Fitted values against believed ones: a unit that explains all of them, or one common factor.
#include "compare/solve.hpp"
#include "diagnose/sanity.hpp"
#include "effects/catalogue.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace servoid {

namespace {

constexpr double kKnown = 0.3;       // std over value of a number that says something of a unit
constexpr double kWellKnown = 0.1;   // the same, of a gain
constexpr double kLeastShare = 0.03; // of the torque that only this number explains
constexpr double kExplained = 0.1;   // error of a fit whose numbers show a gain
constexpr double kOneAlone = 30;     // a single belief may be wrong by less than this
const double kTogether = std::log(1.6), kAlone = std::log(1.3); // off the factor of a unit
const double kGain = std::log(1.2); // less is a belief that is a little wrong
constexpr double kCommon = 0.05;    // scatter about the common factor, beside 2 std

// How a coefficient changes where torque, way or time are recorded so many times too large.
struct Powers {
    double torque = 0, way = 0, time = 0;
};

std::optional<Powers> powers_of(Quantity quantity) {
    switch (quantity) {
    case Quantity::torque:
        return Powers{1, 0, 0};
    case Quantity::viscous:
        return Powers{1, -1, 1};
    case Quantity::inertia:
        return Powers{1, -1, 2};
    case Quantity::stiffness:
        return Powers{1, -1, 0};
    case Quantity::quadratic_drag:
        return Powers{1, -2, 2};
    default:
        return std::nullopt;
    }
}

// One fitted number against what was believed of it.
struct Change {
    std::string name;
    Powers powers;
    double ratio = 0, spread = 0; // logarithm of fitted over believed, and its standard deviation
};

// What each coefficient alone explains of the torque, by name: beyond what the others make up.
std::map<std::string, double> shares_of(const FitResult& fitted, Assembler& assembler) {
    assembler.set_context(fitted.model);
    const Eigen::MatrixXd x = assembler.assemble(fitted.model).columns;
    const Eigen::VectorXd scale = x.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::MatrixXd unit = x * scale.asDiagonal();
    // The part of a column that is its own: one over the diagonal of the inverse of the products.
    const Eigen::VectorXd inflation = pseudo_inverse(unit.transpose() * unit).diagonal();
    std::map<std::string, double> out;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        out[coefficient_name(fitted.model, fitted.coefficients[size_t(i)])] =
            x.col(i).norm() * std::abs(fitted.values[i]) /
            (std::sqrt(std::max(1.0, inflation[i])) * fitted.torque.norm());
    return out;
}

void take(std::vector<Change>& out, const FittedParameter& p, double believed) {
    const std::optional<Powers> powers = powers_of(p.quantity);
    const double ratio = p.estimate.value / believed, spread = p.estimate.std / p.estimate.value;
    if (!powers || p.fixed || p.at_bound || !(ratio > 0) || !std::isfinite(ratio)) return;
    if (std::abs(spread) < kKnown)
        out.push_back({p.name, *powers, std::log(ratio), std::abs(spread)});
}

// What is known of the belief, and matters more than what the fit leaves open.
std::vector<Change> changes_of(const Model& believed, const FitResult& fitted,
                               Assembler& assembler) {
    std::vector<Change> out;
    take(out, fitted.parameters.front(), believed.inertia);
    size_t next = 1;
    for (const EffectTerm& term : believed.effects)
        for (const ParameterInfo& p : find_effect(term.name)->parameters(term))
            take(out, fitted.parameters[next++], term.at(p.key));
    std::map<std::string, double> share = shares_of(fitted, assembler);
    std::erase_if(out, [&](const Change& c) {
        return share[c.name] < std::max(kLeastShare, fitted.torque_error);
    });
    return out;
}

// What may have been mixed up: recorded so many times too large.
struct Mistake {
    Powers of;
    double factor;
    std::string is, read; // "torque in mN·m", "N·m"
};

std::vector<Mistake> mistakes_for(const Model& model, bool has_position) {
    constexpr double turn = 2 * std::numbers::pi;
    const bool linear = model.motion == Motion::linear;
    const Powers torque{1, 0, 0}, way{0, 1, 0}, time{0, 0, 1};
    const std::string force = linear ? "force in " : "torque in ", unit = linear ? "N" : "N·m";
    std::vector<Mistake> out = {{torque, 1000, force + "m" + unit, unit},
                                {time, 1000, "time in ms", "s"},
                                {time, 1e6, "time in µs", "s"}};
    if (linear) out.push_back({way, 1000, "position in mm", "m"});
    if (!linear) {
        out.push_back({way, 360 / turn, "position in degrees", "rad"});
        out.push_back({way, 1 / turn, "position in revolutions", "rad"});
        if (!has_position) out.push_back({way, 60 / turn, "velocity in rpm", "rad/s"});
    }
    if (model.drive.rated_torque > 0)
        out.push_back({torque, 1000 / model.drive.rated_torque, force + "per mille", unit});
    if (model.drive.torque_constant > 0)
        out.push_back({torque, 1 / model.drive.torque_constant, force + "A", unit});
    if (model.sensor.position_per_count > 0)
        out.push_back(
            {way, 1 / model.sensor.position_per_count, "position in counts", linear ? "m" : "rad"});
    return out;
}

// Whether a unit that is `factor` times off in one of the three explains every change.
bool explains(const std::vector<Change>& changes, const Powers& of, double factor) {
    int moved = 0;
    double least = INFINITY, off = 0;
    for (const Change& c : changes) {
        const double power =
            c.powers.torque * of.torque + c.powers.way * of.way + c.powers.time * of.time;
        off = std::max(off, std::abs(c.ratio - power * std::log(factor)));
        if (power != 0) ++moved, least = std::min(least, std::abs(power * std::log(factor)));
    }
    if (moved == 0 || least < std::log(5)) return false;
    return moved > 1 ? off < kTogether : least > std::log(kOneAlone) && off < kAlone;
}

std::string size_of(double log_ratio) {
    const double ratio = std::exp(std::abs(log_ratio));
    return fmt::format("{:.{}f} times too {}", ratio, ratio < 100 ? 1 : 0,
                       log_ratio > 0 ? "large" : "small");
}

// Each number with what became of it, where they differ.
std::string told(const std::vector<Change>& changes) {
    const auto [low, high] =
        std::minmax_element(changes.begin(), changes.end(),
                            [](const Change& a, const Change& b) { return a.ratio < b.ratio; });
    if (changes.size() > 1 && high->ratio - low->ratio < 2 * kTogether)
        return "everything comes out " + size_of((high->ratio + low->ratio) / 2);
    std::string out;
    for (const Change& c : changes)
        if (std::abs(c.ratio) > std::log(5))
            out += (out.empty() ? "" : ", ") + c.name + " comes out " + size_of(c.ratio);
    return out;
}

std::optional<Suspicion> unit_of_all(const Model& believed, const std::vector<Change>& changes,
                                     bool has_position) {
    std::string words;
    for (const Mistake& m : mistakes_for(believed, has_position)) {
        const std::string sep = words.empty() ? "" : ", or ";
        if (explains(changes, m.of, m.factor)) words += sep + m.is + ", read as " + m.read;
        if (explains(changes, m.of, 1 / m.factor))
            words += sep + "a column in " + m.read + ", read as " + m.is;
    }
    if (words.empty()) return std::nullopt;
    return Suspicion{Suspicion::Kind::unit, told(changes) + " against the model (" + words + "?)",
                     "the columns in the units that their names say, or state what the model "
                     "believes in SI",
                     true, std::exp(changes.front().ratio)};
}

// Weighted by how well each is known.
std::optional<Suspicion> common_gain(std::vector<Change> changes) {
    std::erase_if(changes, [](const Change& c) { return c.spread > kWellKnown; });
    double sum = 0, weight = 0;
    for (const Change& c : changes) {
        const double w = 1 / (c.spread * c.spread + kCommon * kCommon);
        sum += w * c.ratio, weight += w;
    }
    if (changes.size() < 2 || changes.front().name != "inertia") return std::nullopt;
    const double mean = sum / weight;
    if (std::abs(mean) < kGain) return std::nullopt;
    for (const Change& c : changes)
        if (std::abs(c.ratio - mean) > std::min(kCommon + 2 * c.spread, std::abs(mean) / 2))
            return std::nullopt;
    return Suspicion{Suspicion::Kind::gain,
                     fmt::format("inertia, friction and all else come out {:.3g} times what is "
                                 "believed, the torque recorded with a gain (rated torque, torque "
                                 "constant, scaling?)",
                                 std::exp(mean)),
                     "check the scale of the torque column", false, std::exp(mean)};
}

} // namespace

std::vector<Suspicion> belief_suspicions(const Model& believed, const FitResult& before,
                                         Assembler& assembler) {
    bool has_position = true;
    for (const PreparedMotion& m : assembler.motions()) {
        if (m.capture->torque_in_ampere) return {}; // beliefs in N·m say nothing of amperes
        has_position = has_position && m.capture->has_position();
    }
    const std::vector<Change> changes = changes_of(believed, before, assembler);
    if (changes.empty()) return {};
    if (const auto unit = unit_of_all(believed, changes, has_position)) return {*unit};
    if (before.torque_error > kExplained) return {};
    if (const auto gain = common_gain(changes)) return {*gain};
    return {};
}

} // namespace servoid
