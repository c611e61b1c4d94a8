// One CAN frame, classic or FD, as a log or a socket gives it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace servoid::can {

struct Frame {
    std::int64_t time_ns = 0; // of the log or the kernel; the epoch is whoever's wrote it
    std::uint32_t id = 0;     // 11 or 29 bit
    bool extended = false;    // 29 bit
    bool fd = false;
    bool remote = false;        // classic only: asks for data, holds none
    bool error = false;         // an error frame: `id` is the error class (linux/can/error.h)
    std::uint8_t fd_flags = 0;  // bit 0 BRS, bit 1 ESI, bit 2 FDF (newer kernels), as the kernel's
    std::uint8_t length = 0;    // bytes of data: 0…8, FD also 12, 16, 20, 24, 32, 48, 64
    std::uint8_t interface = 0; // index into the log's list of interfaces
    std::array<std::uint8_t, 64> data{};

    bool operator==(const Frame&) const = default;
};

// What a log's and the kernel's identifier of an error frame has besides: CAN_ERR_FLAG.
constexpr std::uint32_t error_flag = 0x20000000;

// Identifiers of 11 and of 29 bit are different numbers.
struct FrameId {
    std::uint32_t id = 0;
    bool extended = false;
    auto operator<=>(const FrameId&) const = default;
};
inline FrameId id_of(const Frame& frame) { return {frame.id, frame.extended}; }
std::string to_text(FrameId id); // "0x181", "0x18FF1234x": 3 or 8 digits, x marks 29 bit

} // namespace servoid::can
