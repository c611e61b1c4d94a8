#include "effects/wave.hpp"

#include <Eigen/Cholesky>

#include <algorithm>

namespace servoid {

namespace {

constexpr double kStepsPerCycle = 4; // of a resolvable order
constexpr int kMostOrders = 4000;
constexpr double kOddOrder = 2; // as a logarithm
constexpr int kStarts = 3;      // orders from which a fit begins

// Share of the residual's power explained by [Re c, Im c, 1] for a complex column c.
double explained(const Eigen::VectorXcd& column, const Eigen::VectorXd& residual) {
    const Eigen::VectorXd re = column.real(), im = column.imag();
    Eigen::Matrix3d gram;
    const double n = double(residual.size());
    gram << re.squaredNorm(), re.dot(im), re.sum(), re.dot(im), im.squaredNorm(), im.sum(),
        re.sum(), im.sum(), n;
    const Eigen::Vector3d moment(re.dot(residual), im.dot(residual), residual.sum());
    const double all = moment.dot(gram.ldlt().solve(moment));
    return all - residual.sum() * residual.sum() / n;
}

// What stands for `order` in a term that holds a period.
const ParameterInfo& period_info() {
    static const ParameterInfo info = {"period", Quantity::position, 1e-9,
                                       std::numeric_limits<double>::infinity(), "of one cycle"};
    return info;
}

bool holds_period(const EffectTerm& term) { return term.parameters.contains(period_info().key); }

} // namespace

double cycles_of(const EffectTerm& term) {
    return holds_period(term) ? 1 / term.at(period_info().key) : term.at("order");
}

std::vector<ParameterInfo> OrderEffect::parameters(const EffectTerm& term) const {
    std::vector<ParameterInfo> out = info().parameters;
    for (ParameterInfo& p : out)
        if (p.key == "order" && holds_period(term)) p = period_info();
    return out;
}

std::vector<std::string> OrderEffect::shape_keys(const EffectTerm& term) const {
    return {holds_period(term) ? period_info().key : "order"};
}

double OrderEffect::phase_per_position(const EffectTerm& term, Motion kind) const {
    return wave_number(cycles_of(term), kind);
}

std::vector<double> strongest_orders(const OrderScan& scan, int most) {
    const Search& s = scan.search;
    if (s.position.size() == 0) return {};
    const double travel = s.position.maxCoeff() - s.position.minCoeff();
    const double speed = s.velocity.cwiseAbs().maxCoeff();
    if (!(travel > 0) || !(speed > 0)) return {};
    const double step = kTurn / (kStepsPerCycle * travel);
    const double lowest = kFewestCycles * kTurn / travel;
    // Orders that only the slower part of the motion shows count too: up to four times what the top
    // speed carries through the band.
    const double highest =
        std::min(4 * kTurn * s.motion.band_Hz / speed, lowest + kMostOrders * step);
    const Eigen::Index n = s.position.size();
    Eigen::VectorXcd wave(n), turn(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        wave[i] = std::polar(1.0, lowest * s.position[i]);
        turn[i] = std::polar(1.0, step * s.position[i]);
    }
    std::vector<double> power, orders;
    for (double k = lowest; k < highest; k += step) {
        Eigen::VectorXcd column = wave.cwiseProduct(scan.weight);
        if (scan.weight_kappa.size()) column += k * wave.cwiseProduct(scan.weight_kappa);
        for (Eigen::Index i = 0; i < n; ++i) // what is too fast for the band is not seen
            if (k * std::abs(s.velocity[i]) > 0.8 * kTurn * s.motion.band_Hz) column[i] = 0;
        power.push_back(explained(column, s.residual));
        orders.push_back(k);
        wave = wave.cwiseProduct(turn);
    }
    std::vector<size_t> peaks;
    for (size_t i = 0; i < power.size(); ++i)
        if ((i == 0 || power[i] > power[i - 1]) &&
            (i + 1 == power.size() || power[i] >= power[i + 1]))
            peaks.push_back(i);
    std::sort(peaks.begin(), peaks.end(), [&](size_t a, size_t b) { return power[a] > power[b]; });
    std::vector<double> out;
    for (size_t i = 0; i < peaks.size() && i < size_t(most); ++i)
        out.push_back(orders[peaks[i]]);
    return out;
}

std::vector<EffectTerm> OrderEffect::starts(const Search& search) const {
    std::vector<EffectTerm> out;
    for (double k : strongest_orders(scan(search), kStarts)) {
        EffectTerm term = blank();
        term.parameters["order"] = order_of(k, search.motion.kind);
        out.push_back(term);
    }
    return out;
}

std::string OrderEffect::implausible(const EffectTerm& term, const MotionView& motion) const {
    const double cycles = wave_number(cycles_of(term), motion.kind) * motion.travel() / kTurn;
    return cycles < kFewestCycles ? "the travel holds less than one and a half cycles" : "";
}

Hiding OrderEffect::hide_fraction(Draw& draw) const {
    const double order = draw.order(), phase = draw.phase();
    if (!(order > 0)) return {};
    return {.at =
                [=, this](double s) {
                    return with({{"fraction", s}, {"order", order}, {"phase", phase}});
                },
            .start = 0.1,
            .most = 0.6};
}

double OrderEffect::whole_order_evidence(const Estimates& estimates,
                                         const MotionView& motion) const {
    const auto found = estimates.find("order"); // a term may hold a period instead
    if (motion.kind != Motion::rotary || found == estimates.end()) return 0;
    const Estimate& order = found->second;
    if (order.value < 1.5) return 0; // once a turn is gravity's
    const double within = std::max(2 * order.std, 0.02);
    const double off = std::abs(order.value - std::round(order.value));
    return off < within ? -std::log(std::min(1.0, 2 * within)) : -kOddOrder;
}

} // namespace servoid
