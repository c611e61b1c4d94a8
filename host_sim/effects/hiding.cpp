#include "effects/hiding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kHighestOrder = 72; // per revolution: poles times slots of a large motor

std::mt19937_64 engine_of(std::uint64_t seed, std::uint64_t attempt) {
    std::seed_seq words{std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(attempt)};
    return std::mt19937_64(words);
}

} // namespace

Draw::Draw(const Scenery& scenery, std::uint64_t seed, std::uint64_t attempt)
    : scenery_(scenery), engine_(engine_of(seed, attempt)) {}

double Draw::uniform(double low, double high) {
    const double share = double(engine_() >> 11) * 0x1p-53;
    return low + share * (high - low);
}

double Draw::log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
}

int Draw::integer(int low, int high) {
    return std::min(high, low + int(uniform(0, 1) * (high - low + 1)));
}

double Draw::phase() { return uniform(-std::numbers::pi, std::numbers::pi); }

double Draw::order() {
    const Scenery& s = scenery_;
    if (!(s.travel() > 0)) return 0;
    const double unit = s.kind == Motion::rotary ? kTurn : 1; // of position for one of the order
    const double slowest = 2 / s.travel() * unit;
    const double fastest = 0.7 * s.band_Hz / s.typical_speed * unit;
    if (s.kind == Motion::linear) return fastest > slowest ? log_uniform(slowest, fastest) : 0;
    const int low = int(std::ceil(slowest)), high = int(std::min(fastest, kHighestOrder));
    return high >= low ? integer(low, high) : 0;
}

} // namespace servoid
