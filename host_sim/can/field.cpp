#include "can/field.hpp"

#include <bit>

namespace servoid::can {

namespace {

constexpr int longest_frame = 64; // bytes

// The bytes of a field from its least significant one on. Both orders are one walk: little endian
// goes up through the frame, big endian down.
struct Walk {
    int lowest = 0; // the byte with the least significant bit
    int step = 1;
    int bytes = 0;
    int below = 0; // bits of that byte that lie below the field
};

// How far into a frame a big endian field's first bit is, counted in the order of transmission.
int depth_of(int dbc_bit) { return dbc_bit / 8 * 8 + 7 - dbc_bit % 8; }

Walk walk_of(const Field& field) {
    const bool little = field.order == ByteOrder::little;
    const int first = little ? field.start_bit : depth_of(field.start_bit);
    const int last = first + field.length - 1;
    const int bytes = last / 8 - first / 8 + 1;
    if (little) return {first / 8, 1, bytes, first % 8};
    return {last / 8, -1, bytes, 7 - last % 8};
}

std::uint64_t mask_of(const Field& field) { return ~std::uint64_t{0} >> (64 - field.length); }

// The part of `bits` that byte i of the walk holds, at its place in the byte. A ninth byte comes
// only with below > 0, so no shift reaches 64.
std::uint8_t part_of(std::uint64_t bits, const Walk& walk, int i) {
    const int up = 8 * i - walk.below;
    return static_cast<std::uint8_t>(up < 0 ? bits << -up : bits >> up);
}

// Bits of one byte of the frame that the field has.
std::uint8_t cover_of(const Field& field, int byte) {
    const Walk walk = walk_of(field);
    const int i = (byte - walk.lowest) * walk.step;
    return i >= 0 && i < walk.bytes ? part_of(mask_of(field), walk, i) : std::uint8_t{0};
}

std::string fault_of_length(const Field& field) {
    const std::string length = std::to_string(field.length);
    if (field.kind == FieldKind::float32 && field.length != 32)
        return "a 32-bit float has " + length + " bits; expected 32";
    if (field.kind == FieldKind::float64 && field.length != 64)
        return "a 64-bit float has " + length + " bits; expected 64";
    if (field.length < 1 || field.length > 64) return length + " bits; expected 1…64";
    return "";
}

std::string extent_of(const Field& field) {
    const std::string start = std::to_string(field.start_bit);
    if (field.order == ByteOrder::big)
        return std::to_string(field.length) + " bits from bit " + start + " on, big endian,";
    return "bits " + start + "…" + std::to_string(field.start_bit + field.length - 1);
}

} // namespace

std::string fault_of(const Field& field, int bytes) {
    const std::string fault = fault_of_length(field);
    if (!fault.empty()) return fault;
    if (field.start_bit < 0 || field.start_bit >= 8 * longest_frame)
        return "start bit " + std::to_string(field.start_bit) + "; expected 0…" +
               std::to_string(8 * longest_frame - 1);
    if (bytes_needed(field) <= bytes) return "";
    return extent_of(field) + " leave a frame of " + std::to_string(bytes) + " bytes";
}

int bytes_needed(const Field& field) {
    const Walk walk = walk_of(field);
    return field.order == ByteOrder::little ? walk.lowest + walk.bytes : walk.lowest + 1;
}

bool overlap(const Field& a, const Field& b) {
    if (a.frame != b.frame) return false;
    const Walk walk = walk_of(a);
    for (int i = 0; i < walk.bytes; ++i) {
        const int byte = walk.lowest + i * walk.step;
        if ((cover_of(a, byte) & cover_of(b, byte)) != 0) return true;
    }
    return false;
}

std::int64_t raw_of(const Field& field, const Frame& frame) {
    const Walk walk = walk_of(field);
    std::uint64_t bits = 0;
    for (int i = 0; i < walk.bytes; ++i) {
        const std::uint64_t byte = frame.data[static_cast<size_t>(walk.lowest + i * walk.step)];
        const int up = 8 * i - walk.below;
        bits |= up < 0 ? byte >> -up : byte << up;
    }
    bits &= mask_of(field);
    if (field.kind == FieldKind::signed_integer) {
        const std::uint64_t sign = std::uint64_t{1} << (field.length - 1);
        bits = (bits ^ sign) - sign;
    }
    return static_cast<std::int64_t>(bits);
}

double value_of(const Field& field, const Frame& frame) {
    const std::int64_t raw = raw_of(field, frame);
    const auto bits = static_cast<std::uint64_t>(raw);
    double number = 0;
    switch (field.kind) {
    case FieldKind::unsigned_integer:
        number = static_cast<double>(bits);
        break;
    case FieldKind::signed_integer:
        number = static_cast<double>(raw);
        break;
    case FieldKind::float32:
        number = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        break;
    case FieldKind::float64:
        number = std::bit_cast<double>(bits);
        break;
    }
    return number * field.scale + field.offset;
}

void put_raw(const Field& field, std::int64_t raw, Frame& frame) {
    const Walk walk = walk_of(field);
    const std::uint64_t mask = mask_of(field), bits = static_cast<std::uint64_t>(raw) & mask;
    for (int i = 0; i < walk.bytes; ++i) {
        std::uint8_t& byte = frame.data[static_cast<size_t>(walk.lowest + i * walk.step)];
        const int others = byte & ~part_of(mask, walk, i);
        byte = static_cast<std::uint8_t>(others | part_of(bits, walk, i));
    }
}

} // namespace servoid::can
