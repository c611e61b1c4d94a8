#include "can/cia402_scales.hpp"

#include <numbers>

namespace servoid::can {

namespace {

constexpr std::uint8_t kExpeditedUpload = 0x42; // command 2, expedited; the length in other bits
constexpr std::uint8_t kCommandBits = 0xE2;

} // namespace

void Cia402Scales::add(const Frame& frame) {
    if (frame.error || frame.remote || id_of(frame) != answer_ || frame.length != 8 ||
        (frame.data[0] & kCommandBits) != kExpeditedUpload)
        return;
    const auto& d = frame.data;
    const std::uint32_t object = std::uint32_t(d[2]) << 16 | std::uint32_t(d[1]) << 8 | d[3];
    heard_[object] = std::uint32_t(d[7]) << 24 | std::uint32_t(d[6]) << 16 |
                     std::uint32_t(d[5]) << 8 | std::uint32_t(d[4]);
}

std::optional<double> Cia402Scales::ratio(std::uint16_t index) const {
    const auto first = heard_.find(std::uint32_t(index) << 8 | 1);
    const auto second = heard_.find(std::uint32_t(index) << 8 | 2);
    if (first == heard_.end() || second == heard_.end() || !first->second || !second->second)
        return std::nullopt;
    return double(first->second) / double(second->second);
}

CaptureScales Cia402Scales::complete(CaptureScales known) const {
    const auto rated = heard_.find(0x607600);
    if (!(known.rated_torque > 0) && rated != heard_.end())
        known.rated_torque = rated->second / 1e3;
    if (known.position_per_count > 0) return known;
    const double turn = 2 * std::numbers::pi;
    if (const auto feed = ratio(0x6092))
        known.position_per_count = turn * ratio(0x6091).value_or(1) / *feed;
    else if (const auto increments = ratio(0x608F))
        known.position_per_count = turn / *increments;
    return known;
}

} // namespace servoid::can
