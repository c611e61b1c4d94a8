#include "effects/law_parts.hpp"

#include "common/text.hpp"
#include "effects/law.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace servoid {

namespace {

constexpr int kSamples = 400;
constexpr int kEnough = 20;       // samples at which the law has a finite value
constexpr double kBent = 1e-7;    // of the law's own size: what is less is rounding
constexpr double kDecades = 3;    // sizes of arguments and parameters, around 1
constexpr unsigned kSeed = 20031; // any: the answer shall be the same in every run

using Keys = std::set<std::string>;

struct Sample {
    AxisPoint point;
    std::map<std::string, double> from, to;
};

// Either sign, any size. The generator's own numbers: distributions differ between libraries.
double any_number(std::mt19937_64& random) {
    const double unit = double(random() >> 11) * 0x1p-53;
    const double size = std::pow(10.0, kDecades * (2 * unit - 1));
    return random() % 2 == 0 ? size : -size;
}

std::vector<Sample> samples_of(const std::vector<std::string>& parameters) {
    std::mt19937_64 random(kSeed);
    std::vector<Sample> out(kSamples);
    for (Sample& s : out) {
        for (double* argument : {&s.point.time_s, &s.point.position, &s.point.velocity,
                                 &s.point.acceleration, &s.point.torque})
            *argument = any_number(random);
        for (const std::string& key : parameters)
            s.from[key] = any_number(random), s.to[key] = any_number(random);
    }
    return out;
}

class Trial {
  public:
    Trial(const std::string& law, const std::vector<std::string>& parameters)
        : samples_(samples_of(parameters)), law_(law, samples_.front().from) {}

    // With the moved parameters a share of the way from their first values to their second.
    double value(const Sample& s, const Keys& moved, double share) {
        for (const auto& [key, from] : s.from)
            law_.set(key, moved.contains(key) ? from + share * (s.to.at(key) - from) : from);
        return law_.at(s.point);
    }

    bool is_straight(const Keys& moved) {
        int finite = 0;
        for (const Sample& s : samples_) {
            const double first = value(s, moved, 0), last = value(s, moved, 1),
                         middle = value(s, moved, 0.5);
            if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(middle)) continue;
            ++finite;
            const double size = std::max({std::abs(first), std::abs(last), std::abs(middle)});
            if (std::abs(middle - (first + last) / 2) > kBent * size) return false;
        }
        return finite >= kEnough;
    }

    bool vanishes_without(const Keys& zero) {
        int finite = 0;
        for (const Sample& s : samples_) {
            for (const auto& [key, from] : s.from)
                law_.set(key, zero.contains(key) ? 0 : from);
            const double rest = law_.at(s.point);
            if (!std::isfinite(rest)) continue;
            if (rest != 0) return false;
            ++finite;
        }
        return finite >= kEnough;
    }

  private:
    std::vector<Sample> samples_;
    Law law_;
};

LawParts find_parts(const std::string& law, const std::vector<std::string>& parameters) {
    Trial trial(law, parameters);
    std::vector<std::string> order = parameters;
    std::stable_sort(order.begin(), order.end());
    std::stable_partition(order.begin(), order.end(),
                          [&](const std::string& key) { return trial.vanishes_without({key}); });
    Keys linear;
    for (const std::string& key : order) {
        Keys more = linear;
        more.insert(key);
        if (trial.is_straight(more)) linear = more;
    }
    LawParts out;
    for (const std::string& key : Keys(order.begin(), order.end()))
        (linear.contains(key) ? out.linear : out.shapes).push_back(key);
    out.rest = !trial.vanishes_without(linear);
    return out;
}

} // namespace

const LawParts& parts_of(const std::string& law, const std::vector<std::string>& parameters) {
    thread_local std::map<std::string, LawParts> known;
    const std::string key = law + "|" + join(parameters, ",");
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    return known.emplace(key, find_parts(law, parameters)).first->second;
}

} // namespace servoid
