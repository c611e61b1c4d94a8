#include "story/worst.hpp"

#include "compare/where.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace servoid {

namespace {

constexpr int kParts = 40;      // of the record: the length of a stretch
constexpr int kMost = 5;        // stretches
constexpr double kDenser = 1.5; // than the record as a whole

struct Stretch {
    Eigen::Index first = 0, count = 0;
    double power = 0; // share of the whole
};

// Half overlapping, worst first.
std::vector<Stretch> stretches_of(const Eigen::VectorXd& power) {
    const Eigen::Index length = std::max<Eigen::Index>(4, power.size() / kParts);
    std::vector<Stretch> out;
    for (Eigen::Index first = 0; first + length <= power.size(); first += (length + 1) / 2)
        out.push_back({first, length, power.segment(first, length).sum() / power.sum()});
    std::stable_sort(out.begin(), out.end(),
                     [](const Stretch& a, const Stretch& b) { return a.power > b.power; });
    return out;
}

bool overlap(const Stretch& a, const Stretch& b) {
    return a.first < b.first + b.count && b.first < a.first + a.count;
}

// The regime that holds most of the residual there.
std::string most_of(const Stretch& s, const Eigen::VectorXd& power,
                    const std::vector<std::string>& regimes) {
    std::map<std::string, double> sums;
    for (Eigen::Index k = s.first; k < s.first + s.count; ++k)
        sums[regimes[size_t(k)]] += power[k];
    return std::max_element(sums.begin(), sums.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

} // namespace

Json worst_json(const SceneCapture& capture) {
    const PreparedMotion& m = capture.motion;
    Eigen::VectorXd power = capture.residual().array().square();
    for (Eigen::Index k = 0; k < power.size(); ++k)
        if (!m.used[size_t(k)]) power[k] = 0;
    Json out = Json::array();
    if (!(power.sum() > 0)) return out;
    const std::vector<std::string> regimes = motion_regimes(m);
    std::vector<Stretch> taken;
    for (const Stretch& s : stretches_of(power)) {
        const double samples = double(s.count) / double(power.size());
        if (taken.size() == kMost || s.power < kDenser * samples) break;
        if (std::any_of(taken.begin(), taken.end(),
                        [&](const Stretch& t) { return overlap(s, t); }))
            continue;
        taken.push_back(s);
        out.push_back({{"from_s", m.grid.at(s.first)},
                       {"to_s", m.grid.at(s.first + s.count)},
                       {"residual_share", s.power},
                       {"sample_share", samples},
                       {"what", most_of(s, power, regimes)}});
    }
    return out;
}

} // namespace servoid
