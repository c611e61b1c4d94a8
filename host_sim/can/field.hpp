// A number in the bits of a frame.
#pragma once

#include "can/frame.hpp"

#include <string>

namespace servoid::can {

enum class ByteOrder {
    little, // start_bit is the least significant bit; bits count up through the bytes (Intel)
    big     // start_bit is the most significant bit, counted as a DBC does: 7 is the first byte's
            // highest bit, 0 its lowest, 15 the second's highest (Motorola)
};

enum class FieldKind { unsigned_integer, signed_integer, float32, float64 };

// value = raw * scale + offset
struct Field {
    std::string name; // for messages
    FrameId frame;
    int start_bit = 0, length = 0; // length 1…64
    ByteOrder order = ByteOrder::little;
    FieldKind kind = FieldKind::unsigned_integer;
    double scale = 1, offset = 0;
};

// "" where the field lies within `bytes` and its length suits its kind, else what is wrong:
// "bits 56…71 leave a frame of 8 bytes".
std::string fault_of(const Field& field, int bytes);

// What follows is for fields without fault within 64 bytes.

// Bytes that a frame must have at least to hold it.
int bytes_needed(const Field& field);

// Whether two fields share a bit; those of different frames never do.
bool overlap(const Field& a, const Field& b);

// The bits as they are (sign extended for signed_integer; the pattern of a float; of an unsigned
// number of 64 bits the same bits). The frame must hold bytes_needed().
std::int64_t raw_of(const Field& field, const Frame& frame);
double value_of(const Field& field, const Frame& frame);

// Writes the bits; others stay.
void put_raw(const Field& field, std::int64_t raw, Frame& frame);

} // namespace servoid::can
