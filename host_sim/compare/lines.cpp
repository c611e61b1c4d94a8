#include "compare/lines.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <complex>
#include <numeric>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Mask = std::vector<bool>;

constexpr double kExcited = 1e-3;    // of the strongest line's amplitude
constexpr double kAboveNoise = 4;    // an excited line's amplitude over that of the noise beside it
constexpr double kMostMasked = 0.05; // of a period: more standstill spreads lines over the others
constexpr double kStop = 1.45;       // of the band edge: the band limit lets nothing through above
constexpr double kSameBase = 1e-3;

// Rows: whole periods at the end of the grid.
struct Fold {
    Eigen::Index points = 0, periods = 0;
    Eigen::Index first(const Vector& signal) const {
        return signal.size() / points * points - periods * points;
    }
};

Fold fold_of(const PeriodicResidual& c) {
    const auto points = Eigen::Index(std::lround(*c.motion.period_s / c.motion.grid.step_s));
    const Eigen::Index whole = c.residual.size() / points;
    return {points, std::clamp<Eigen::Index>(c.periods, std::min<Eigen::Index>(1, whole), whole)};
}

// A phase counts where it is used in every period, and half a period away as well.
Mask mask_of(const PreparedMotion& m, const Fold& fold, Eigen::Index first) {
    const auto used = [&](Eigen::Index phase) {
        for (Eigen::Index p = 0; p < fold.periods; ++p)
            if (!m.used[size_t(first + p * fold.points + phase % fold.points)]) return false;
        return true;
    };
    Mask out;
    for (Eigen::Index j = 0; j < fold.points; ++j)
        out.push_back(used(j) && used(j + fold.points / 2));
    return out;
}

// Mean squares, by line k at k/period.
struct Harmonics {
    Vector power;   // of the mean period
    Vector between; // of what differs between periods, near this line
};

void add_power(const Eigen::RowVectorXd& period, Vector& out, double weight) {
    const std::vector<double> samples(period.begin(), period.end());
    std::vector<std::complex<double>> spectrum;
    Eigen::FFT<double> fft;
    fft.fwd(spectrum, samples); // both sides
    const auto n = Eigen::Index(samples.size());
    for (Eigen::Index k = 0; k < n; ++k)
        out[std::min(k, n - k)] += weight * std::norm(spectrum[size_t(k)]) / double(n * n);
}

Harmonics harmonics_of(const Vector& signal, const Fold& fold, const Mask& mask) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Matrix rows =
        Eigen::Map<const RowMajor>(signal.data() + fold.first(signal), fold.periods, fold.points);
    for (Eigen::Index j = 0; j < fold.points; ++j)
        if (!mask[size_t(j)]) rows.col(j).setZero();
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    Harmonics out{Vector::Zero(fold.points / 2 + 1), Vector::Zero(fold.points / 2 + 1)};
    add_power(mean, out.power, 1);
    for (Eigen::Index p = 0; p < fold.periods; ++p)
        add_power(rows.row(p) - mean, out.between, 1 / double(fold.periods));
    return out;
}

// The acceleration that the reference asks for, on the grid: its lines are those of the torque. Of
// the torque itself where no reference was recorded.
Vector excitation_of(const PreparedMotion& m) {
    const Capture& c = *m.capture;
    const bool position = !c.position_ref.empty();
    const std::vector<double>& reference = position ? c.position_ref : c.velocity_ref;
    if (reference.empty()) return m.torque;
    const Eigen::Map<const Vector> samples(reference.data(), Eigen::Index(reference.size()));
    return m.low_pass->apply(samples, m.grid, position ? 2 : 1);
}

std::vector<int> excited_lines(const Harmonics& excitation, const Fold& fold, int last) {
    const double strongest = excitation.power.segment(1, last).maxCoeff();
    std::vector<int> out;
    for (int k = 1; k <= last; ++k) {
        // From the places between this line and the next to the line itself.
        const double noise = excitation.between[k] / std::max(1.0, double(fold.periods - 1));
        const double least =
            std::max(kExcited * kExcited * strongest, kAboveNoise * kAboveNoise * noise);
        if (excitation.power[k] > least) out.push_back(k);
    }
    return out;
}

// What each line of the period is. The base frequency is that of the excited lines: a period that
// was stated may hold several of theirs.
struct Plan {
    Fold fold;
    Mask mask;
    int base = 0, last = 0; // lines of the period
    std::vector<bool> excited;
    bool parity = false;       // only odd multiples of the base are excited
    bool odd_is_sharp = false; // hardly any standstill
};

std::optional<Plan> plan_of(const PeriodicResidual& c) {
    const PreparedMotion& m = c.motion;
    if (!m.period_s || !m.capture->uniform) return std::nullopt;
    Plan plan;
    plan.fold = fold_of(c);
    plan.last = int(std::min(double(plan.fold.points / 2), kStop * m.band_Hz * *m.period_s));
    if (plan.fold.periods < 1 || plan.last < 2) return std::nullopt;
    const Vector excitation = excitation_of(m);
    const Mask all(size_t(plan.fold.points), true);
    plan.excited.assign(size_t(plan.last) + 1, false);
    for (int k : excited_lines(harmonics_of(excitation, plan.fold, all), plan.fold, plan.last)) {
        plan.excited[size_t(k)] = true;
        plan.base = std::gcd(plan.base, k);
    }
    if (plan.base == 0) return std::nullopt;
    plan.parity = 2 * plan.base <= plan.last;
    for (int k = 2 * plan.base; k <= plan.last; k += 2 * plan.base)
        plan.parity = plan.parity && !plan.excited[size_t(k)];
    plan.mask = mask_of(m, plan.fold, plan.fold.first(excitation));
    const auto masked = std::count(plan.mask.begin(), plan.mask.end(), false);
    plan.odd_is_sharp = double(masked) <= kMostMasked * double(plan.fold.points);
    return plan;
}

// Mean squares of one signal.
struct Sums {
    LineKinds lines{0, 0, 0}, noise{0, 0, 0};
    double mean = 0;
    void add(const Sums& one, double weight) {
        for (double LineKinds::*kind : {&LineKinds::excited, &LineKinds::odd, &LineKinds::even})
            lines.*kind += weight * one.lines.*kind, noise.*kind += weight * one.noise.*kind;
        mean += weight * one.mean;
    }
};

double LineKinds::*kind_of(const Plan& plan, int k) {
    if (plan.excited[size_t(k)]) return &LineKinds::excited;
    return k / plan.base % 2 ? &LineKinds::odd : &LineKinds::even;
}

Sums sums_of(const Vector& signal, const Plan& plan) {
    const Harmonics h = harmonics_of(signal, plan.fold, plan.mask);
    // From all places between one multiple of the base and the next to the one that is a line.
    const double places = double(plan.fold.periods * plan.base - 1);
    Sums out;
    out.mean = h.power[0];
    double beside = 0;
    for (int k = 1; k <= plan.last; ++k) {
        beside += h.between[k] + (k % plan.base ? h.power[k] : 0);
        if (k % plan.base) continue;
        out.lines.*kind_of(plan, k) += h.power[k];
        out.noise.*kind_of(plan, k) += places > 0 ? beside / places : NAN;
        beside = 0;
    }
    return out;
}

LineCounts counts_of(const Plan& plan) {
    LineCounts out;
    for (int k = plan.base; k <= plan.last; k += plan.base)
        ++(plan.excited[size_t(k)] ? out.excited : k / plan.base % 2 ? out.odd : out.even);
    return out;
}

LineKinds ratios(const LineKinds& sum, double torque_power, bool odd) {
    const auto ratio = [&](double power) { return std::sqrt(power / torque_power); };
    return {ratio(sum.excited), odd ? ratio(sum.odd) : NAN, ratio(sum.even)};
}

} // namespace

std::optional<Lines> lines_of(const std::vector<PeriodicResidual>& captures) {
    Lines out;
    Sums residual, torque;
    double torque_power = 0;
    bool odd = true;
    for (const PeriodicResidual& c : captures) {
        const std::optional<Plan> plan = plan_of(c);
        if (!plan || !plan->parity) continue;
        const double base_Hz = plan->base / *c.motion.period_s;
        const LineCounts counts = counts_of(*plan);
        if (torque_power == 0)
            out.base_Hz = base_Hz, out.counts = counts;
        else if (!(std::abs(base_Hz - out.base_Hz) <= kSameBase * base_Hz))
            out.base_Hz = NAN;
        odd = odd && plan->odd_is_sharp && counts.odd > 0;
        // A mean square of all points, the masked ones zero, stands for the used ones.
        const double weight = double(c.motion.grid.count);
        residual.add(sums_of(c.residual, *plan), weight);
        torque.add(sums_of(c.motion.torque, *plan), weight);
        torque_power += c.motion.used_power(c.motion.torque);
    }
    if (!(torque_power > 0)) return std::nullopt;
    out.residual = ratios(residual.lines, torque_power, odd);
    out.torque = ratios(torque.lines, torque_power, odd);
    out.noise = ratios(residual.noise, torque_power, odd);
    const LineKinds& n = residual.noise;
    out.between = std::sqrt((n.excited + n.odd + n.even) / torque_power);
    out.mean = std::sqrt(residual.mean / torque_power);
    return out;
}

} // namespace servoid
