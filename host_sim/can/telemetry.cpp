#include "can/telemetry.hpp"

#include <cmath>

namespace servoid::can {

namespace {

constexpr int kRowBytes = 11, kHeader = 8;

std::uint32_t number(const Frame& frame, std::size_t at, int bytes) {
    std::uint32_t out = 0;
    for (int i = bytes - 1; i >= 0; --i)
        out = out << 8 | frame.data[at + std::size_t(i)];
    return out;
}

double scaled(const Frame& frame, std::size_t mantissa, std::size_t exponent) {
    return std::ldexp(double(std::int32_t(number(frame, mantissa, 4))),
                      std::int16_t(number(frame, exponent, 2)));
}

TelemetryRow row_of(const Frame& frame, std::size_t at) {
    TelemetryRow out;
    out.position_raw = number(frame, at, 4);
    out.reference_q8 = std::int32_t(number(frame, at + 4, 4));
    out.torque_pu_q20 = std::int32_t(number(frame, at + 8, 3) << 8) >> 8;
    return out;
}

Telemetry samples_of(const Frame& frame) {
    TelemetrySamples out;
    out.rows = frame.data[1];
    if (out.rows < 1 || out.rows > 5 || frame.length < 64) return {};
    out.sequence = std::uint16_t(number(frame, 2, 2));
    out.tick = number(frame, 4, 4);
    for (int i = 0; i < out.rows; ++i)
        out.row[std::size_t(i)] = row_of(frame, std::size_t(kHeader + i * kRowBytes));
    out.state = frame.data[63];
    return out;
}

bool is_plausible(const TelemetryDescription& d) {
    return d.sample_rate_uHz > 0 && d.rated_torque > 0 && d.count > 0 && d.position_bits >= 1 &&
           d.position_bits <= 32 && d.position_shift <= 8 &&
           d.torque_timing <= SID_TORQUE_HELD_LAST;
}

Telemetry description_of(const Frame& frame) {
    if (frame.length < 48 || frame.data[1] != 1) return {};
    TelemetryDescription out;
    out.sequence = std::uint16_t(number(frame, 2, 2));
    out.tick = number(frame, 4, 4);
    out.sample_rate_uHz =
        std::uint64_t(number(frame, 12, 4)) << 32 | std::uint64_t(number(frame, 8, 4));
    out.rated_torque = scaled(frame, 16, 20);
    out.count = scaled(frame, 24, 22);
    out.start_tick = number(frame, 32, 4), out.end_tick = number(frame, 36, 4);
    out.start_raw = number(frame, 40, 4);
    out.position_bits = frame.data[44], out.position_shift = frame.data[45];
    out.torque_timing = sid_torque_timing_t(frame.data[46]);
    out.linear = (frame.data[47] & 1) != 0;
    if (!is_plausible(out)) return {};
    return out;
}

} // namespace

Telemetry decode_telemetry(const Frame& frame) {
    if (frame.error || frame.remote || frame.length < 12) return {};
    if (frame.data[0] == 1) return samples_of(frame);
    if (frame.data[0] == 2) return description_of(frame);
    if (frame.data[0] != 3) return {};
    return TelemetryProgress{std::uint16_t(number(frame, 2, 2)), frame.data[1], number(frame, 4, 4),
                             number(frame, 8, 4)};
}

} // namespace servoid::can
