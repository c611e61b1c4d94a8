// The step of a column of numbers: the widest lattice that (nearly) all values lie on.
#include "capture/checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace servoid {

namespace {

constexpr size_t most_samples = 1 << 16;
constexpr double on_lattice_share = 0.99;
constexpr double chance_limit = 1e-4; // of finding a lattice in values that have none
constexpr int digits_of_a_print = 10; // with more, the last digit says nothing about the recording

struct Lattice {
    double step = 0, offset = 0;
};

// Distinct values in order; closer than a printing error is the same value.
std::vector<double> levels_of(const std::vector<double>& values, double rounding) {
    const size_t stride = values.size() / most_samples + 1;
    std::vector<double> sorted;
    sorted.reserve(values.size() / stride + 1);
    for (size_t i = 0; i < values.size(); i += stride)
        sorted.push_back(values[i]);
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> levels;
    for (const double value : sorted)
        if (levels.empty() || value - levels.back() > 1.5 * rounding) levels.push_back(value);
    // So few levels cannot show a lattice by themselves; speeds and torques count from zero.
    constexpr size_t few = 10;
    if (levels.size() > 1 && levels.size() < few &&
        !std::binary_search(levels.begin(), levels.end(), 0.0))
        levels.insert(std::lower_bound(levels.begin(), levels.end(), 0.0), 0.0);
    return levels;
}

// Narrow gaps give a first step; it gets sharper with every wider gap that it can then count.
double refine_step(const std::vector<double>& levels, double step) {
    for (double reach = 3; reach < 1e9; reach *= 2) {
        double product = 0, square = 0;
        bool wider = false;
        for (size_t i = 1; i < levels.size(); ++i) {
            const double gap = levels[i] - levels[i - 1];
            const double count = std::round(gap / step);
            if (count > reach)
                wider = true;
            else {
                product += gap * count;
                square += count * count;
            }
        }
        if (square > 0) step = product / square;
        if (!wider) break;
    }
    return step;
}

// How many steps each level is above the lowest.
std::vector<double> counts_of(const std::vector<double>& levels, double step) {
    std::vector<double> counts(levels.size());
    for (size_t i = 1; i < levels.size(); ++i)
        counts[i] = counts[i - 1] + std::round((levels[i] - levels[i - 1]) / step);
    return counts;
}

// Straight line through the levels over their counts, leaving out what is `allowed` off the last
// one.
Lattice fit_line(const std::vector<double>& levels, const std::vector<double>& counts,
                 const Lattice& last, double allowed) {
    double n = 0, sum_k = 0, sum_y = 0, sum_kk = 0, sum_ky = 0;
    for (size_t i = 0; i < levels.size(); ++i) {
        const double k = counts[i], y = levels[i] - levels[0];
        if (std::abs(levels[i] - last.offset - k * last.step) > allowed) continue;
        n += 1, sum_k += k, sum_y += y, sum_kk += k * k, sum_ky += k * y;
    }
    const double spread = n * sum_kk - sum_k * sum_k;
    if (spread <= 0) return {};
    const double step = (n * sum_ky - sum_k * sum_y) / spread;
    return {step, levels[0] + (sum_y - step * sum_k) / n};
}

// The line through all levels, then twice more without the farthest of them: a few stray values
// would pull it away from all the others.
Lattice fit_lattice(const std::vector<double>& levels, double step) {
    const auto counts = counts_of(levels, step);
    Lattice lattice = fit_line(levels, counts, {}, std::numeric_limits<double>::infinity());
    std::vector<double> off(levels.size());
    for (int repeat = 0; repeat < 2 && lattice.step > 0; ++repeat) {
        for (size_t i = 0; i < levels.size(); ++i)
            off[i] = std::abs(levels[i] - lattice.offset - counts[i] * lattice.step);
        const auto kept =
            static_cast<size_t>(on_lattice_share * static_cast<double>(off.size() - 1));
        std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(kept), off.end());
        lattice = fit_line(levels, counts, lattice, off[kept]);
    }
    return lattice;
}

bool lies_within(const std::vector<double>& levels, const Lattice& lattice, double allowed) {
    // A lattice as fine as the rounding fits everything: it must be able to fail.
    const double chance = 2 * allowed / lattice.step;
    if (!(chance < 0.48)) return false;
    if (std::pow(chance, static_cast<double>(levels.size()) - 2) > chance_limit) return false;
    size_t on = 0;
    for (const double level : levels) {
        const double k = std::round((level - lattice.offset) / lattice.step);
        on += std::abs(level - lattice.offset - k * lattice.step) <= allowed;
    }
    return static_cast<double>(on) >= on_lattice_share * static_cast<double>(levels.size());
}

// The fitted line may itself be off by a rounding where the levels are few; a fine lattice can only
// be told from chance with the tighter allowance.
bool lies_on(const std::vector<double>& levels, const Lattice& lattice, double rounding) {
    return lies_within(levels, lattice, 2.1 * rounding) ||
           lies_within(levels, lattice, 1.3 * rounding);
}

// Steps worth trying, widest first: the narrowest gaps, leaving out up to 2 % that may be stray
// values, and their simple fractions, as every gap may be a multiple of the step.
std::vector<double> candidate_steps(const std::vector<double>& levels) {
    std::vector<double> gaps;
    for (size_t i = 1; i < levels.size(); ++i)
        gaps.push_back(levels[i] - levels[i - 1]);
    std::sort(gaps.begin(), gaps.end());
    std::vector<double> steps;
    for (const double share : {0.0, 0.002, 0.005, 0.01, 0.02}) {
        const double gap = gaps[static_cast<size_t>(share * static_cast<double>(gaps.size() - 1))];
        for (int part = 1; part <= 6; ++part)
            steps.push_back(gap / part);
    }
    std::sort(steps.rbegin(), steps.rend());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

} // namespace

double find_quantum(const std::vector<double>& values, const Printing& printing) {
    double largest = 0;
    for (const double value : values)
        largest = std::max(largest, std::abs(value));
    if (largest == 0 || printing.significant == 0) return 0;
    const double rounding = printing.rounding(largest);
    const auto levels = levels_of(values, rounding);
    if (levels.size() < 3) return 0; // nothing moved: no step was seen
    for (const double candidate : candidate_steps(levels)) {
        const Lattice lattice = fit_lattice(levels, refine_step(levels, candidate));
        if (lattice.step > 0 && lies_on(levels, lattice, rounding)) return lattice.step;
    }
    return printing.significant <= digits_of_a_print ? 2 * rounding : 0;
}

} // namespace servoid
