#include "story/bins.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace servoid {

namespace {

constexpr double kFewest = 5;

struct Sums {
    double count = 0, sum = 0, power = 0;
};

Point extremes_of(const std::vector<Point>& points) {
    std::vector<double> places;
    for (const Point& p : points)
        places.push_back(p.first);
    const auto at = [&](double part) {
        const auto place = places.begin() + long(part * double(places.size() - 1));
        std::nth_element(places.begin(), place, places.end());
        return *place;
    };
    const double low = at(0.001);
    return {low, at(0.999)};
}

// To six digits: a plot shows no more, and the text is a third as long.
double shortened(double value) {
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

MeanBin bin_of(const Sums& s, const Sums& all) {
    MeanBin out;
    out.mean = s.sum / s.count;
    out.std = std::sqrt(std::max(0.0, s.power / s.count - out.mean * out.mean));
    out.power_share = all.power > 0 ? s.power / all.power : 0;
    out.count_share = s.count / all.count;
    return out;
}

} // namespace

std::vector<MeanBin> mean_over(const std::vector<Point>& points, size_t bins) {
    if (points.empty()) return {};
    const auto [low, high] = extremes_of(points);
    const double width = (high - low) / double(bins);
    if (!(width > 0)) return {};
    std::vector<Sums> sums(bins);
    Sums all;
    for (const auto& [place, value] : points) {
        const double at = std::clamp((place - low) / width, 0.0, double(bins) - 1);
        for (Sums* s : {&sums[size_t(at)], &all})
            s->count += 1, s->sum += value, s->power += value * value;
    }
    std::vector<MeanBin> out;
    for (size_t i = 0; i < bins; ++i) {
        if (sums[i].count < kFewest) continue;
        out.push_back(bin_of(sums[i], all));
        out.back().from = low + double(i) * width, out.back().to = low + double(i + 1) * width;
    }
    return out;
}

std::vector<Point> thinned(const std::vector<Point>& points, size_t most) {
    if (points.size() <= most) return points;
    std::vector<double> sizes;
    for (const Point& p : points)
        sizes.push_back(std::abs(p.second));
    const auto tenth = sizes.begin() + long(most / 10);
    std::nth_element(sizes.begin(), tenth, sizes.end(), std::greater<>());
    const double large = *tenth;
    const size_t every = points.size() / (most - most / 10) + 1;
    std::vector<Point> out;
    for (size_t i = 0; i < points.size(); ++i)
        if (i % every == 0 || std::abs(points[i].second) > large) out.push_back(points[i]);
    return out;
}

Json numbers(const std::vector<double>& values) {
    Json out = Json::array();
    for (const double value : values)
        out.push_back(number(std::isfinite(value) ? shortened(value) : value));
    return out;
}

} // namespace servoid
