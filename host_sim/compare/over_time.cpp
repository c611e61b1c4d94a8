#include "compare/over_time.hpp"

#include "compare/compare.hpp"
#include "compare/where.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace servoid {

namespace {

// Of the instants from `first` to before `last`.
TimePart part_of(const PreparedMotion& m, const Eigen::VectorXd& residual,
                 const std::vector<std::string>& regimes, Eigen::Index first, Eigen::Index last) {
    std::map<std::string, double> power;
    double sum = 0;
    long count = 0;
    for (Eigen::Index k = first; k < last; ++k) {
        if (!m.used[size_t(k)]) continue;
        const double r2 = residual[k] * residual[k];
        power[regimes[size_t(k)]] += r2, sum += r2, ++count;
    }
    TimePart out{0, m.grid.at(first), m.grid.at(last), NAN, ""};
    if (count == 0) return out;
    out.rms = std::sqrt(sum / double(count));
    out.regime = std::max_element(power.begin(), power.end(), [](const auto& a, const auto& b) {
                     return a.second < b.second;
                 })->first;
    return out;
}

} // namespace

std::vector<TimePart> residual_over_time(const Model& model, const Homing& homing,
                                         const std::vector<PreparedMotion>& motions, int parts) {
    double total = 0;
    for (const PreparedMotion& m : motions)
        total += double(m.torque.size());
    std::vector<TimePart> out;
    for (size_t i = 0; i < motions.size(); ++i) {
        const PreparedMotion& m = motions[i];
        const Eigen::VectorXd residual = residual_torque(at_zero(model, homing.of(i)), m);
        const std::vector<std::string> regimes = motion_regimes(m);
        const Eigen::Index size = residual.size();
        const auto share = Eigen::Index(std::lround(parts * double(size) / total));
        const Eigen::Index count = std::clamp<Eigen::Index>(share, 1, size);
        for (Eigen::Index k = 0; k < count; ++k) {
            out.push_back(part_of(m, residual, regimes, k * size / count, (k + 1) * size / count));
            out.back().capture = i;
        }
    }
    return out;
}

double rms_of(const std::vector<TimePart>& parts) {
    double sum = 0, count = 0;
    for (const TimePart& p : parts)
        if (std::isfinite(p.rms)) sum += p.rms * p.rms, ++count;
    return count > 0 ? std::sqrt(sum / count) : 0;
}

std::vector<size_t> worst_of(const std::vector<TimePart>& parts, size_t most, double factor) {
    const double least = factor * rms_of(parts);
    const auto at = [&](size_t i) {
        return i < parts.size() && std::isfinite(parts[i].rms) ? parts[i].rms : 0;
    };
    std::vector<size_t> out;
    for (size_t i = 0; i < parts.size(); ++i)
        if (at(i) > least && at(i) >= at(i + 1) && (i == 0 || at(i) > at(i - 1))) out.push_back(i);
    std::stable_sort(out.begin(), out.end(), [&](size_t a, size_t b) { return at(a) > at(b); });
    if (out.size() > most) out.resize(most);
    return out;
}

} // namespace servoid
