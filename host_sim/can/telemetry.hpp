// The telemetry frames of a servoid drive (SPEC.md, "On the bus"), as the core packs them.
#pragma once

#include "can/frame.hpp"
#include "servoid/sid_inertia.h"

#include <cstdint>
#include <variant>

namespace servoid::can {

struct TelemetryRow {
    std::uint32_t position_raw = 0;
    std::int32_t reference_q8 = 0;
    std::int32_t torque_pu_q20 = 0;
    bool operator==(const TelemetryRow&) const = default;
};

struct TelemetrySamples {
    std::uint16_t sequence = 0;
    std::uint32_t tick = 0; // of the first row
    int rows = 0;           // 1…5
    std::array<TelemetryRow, 5> row{};
    std::uint8_t state = 0; // sid_state_t
};

// What the drive's integers mean, and its last start.
struct TelemetryDescription {
    std::uint16_t sequence = 0;
    std::uint32_t tick = 0;
    std::uint64_t sample_rate_uHz = 0;
    double rated_torque = 0; // N·m or N
    double count = 0;        // rad or m
    std::uint32_t start_tick = 0, end_tick = 0, start_raw = 0;
    int position_bits = 32, position_shift = 0;
    sid_torque_timing_t torque_timing = SID_TORQUE_SAMPLED;
    bool linear = false;
    bool started() const { return start_tick != 0; }
    bool ended() const { return end_tick != 0; }
    double sample_time_s() const { return 1e6 / double(sample_rate_uHz); }
};

// How far a streamed move has come.
struct TelemetryProgress {
    std::uint16_t sequence = 0;
    std::uint8_t state = 0;
    std::uint32_t filled = 0, played = 0;
};

// monostate: too short, an unknown kind or version, or numbers that no drive has.
using Telemetry =
    std::variant<std::monostate, TelemetrySamples, TelemetryDescription, TelemetryProgress>;
Telemetry decode_telemetry(const Frame& frame);

// Identifiers of a node.
constexpr FrameId telemetry_id(int node) { return {0x480U + std::uint32_t(node), false}; }
constexpr FrameId references_id(int node) { return {0x500U + std::uint32_t(node), false}; }
constexpr FrameId answer_id(int node) { return {0x580U + std::uint32_t(node), false}; }
constexpr FrameId request_id(int node) { return {0x600U + std::uint32_t(node), false}; }
constexpr FrameId heartbeat_id(int node) { return {0x700U + std::uint32_t(node), false}; }

} // namespace servoid::can
