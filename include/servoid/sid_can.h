/// A CAN frame as the core fills it, and little-endian numbers in its data.
///
/// Purpose     What sid_node hands to the port and gets from it. The port copies it to its
///             controller; the core knows no registers.
/// Units       11-bit identifiers. length is that of CAN FD: 0..8, 12, 16, 20, 24, 32, 48, 64.
/// Overflow    The caller keeps `at` within the data; nothing is checked.
/// Interrupt   All are constant-time.
/// Memory      sizeof(sid_can_frame_t) = 72 bytes.
#ifndef SERVOID_SID_CAN_H
#define SERVOID_SID_CAN_H

#include "servoid/sid_fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SID_CAN_BYTES 64U

typedef struct {
    uint32_t id;    ///< 0..0x7FF
    uint8_t length; ///< of the data, bytes
    bool fd;        ///< CAN FD, with the faster bit rate for the data
    uint8_t data[SID_CAN_BYTES];
} sid_can_frame_t;

SID_STATIC_ASSERT(sizeof(sid_can_frame_t) == 72, frame_has_its_stated_size);

/// Little-endian, at any address.
static inline void sid_put_u16(uint8_t* at, uint16_t value) {
    at[0] = (uint8_t)(value & 0xFFU);
    at[1] = (uint8_t)(value >> 8);
}
static inline void sid_put_u32(uint8_t* at, uint32_t value) {
    sid_put_u16(at, (uint16_t)(value & 0xFFFFU));
    sid_put_u16(at + 2, (uint16_t)(value >> 16));
}
static inline uint16_t sid_get_u16(const uint8_t* at) {
    return (uint16_t)((uint32_t)at[0] | ((uint32_t)at[1] << 8));
}
static inline uint32_t sid_get_u32(const uint8_t* at) {
    return (uint32_t)sid_get_u16(at) | ((uint32_t)sid_get_u16(at + 2) << 16);
}

#ifdef __cplusplus
}
#endif
#endif
