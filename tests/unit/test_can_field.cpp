// Fields against a model that knows single bits only, and against examples from the literature.
#include "can/field.hpp"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <gtest/gtest.h>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

using namespace servoid::can;

namespace {

constexpr auto little = ByteOrder::little;
constexpr auto big = ByteOrder::big;
constexpr unsigned seed = 20240917;

Frame frame_with(std::initializer_list<int> bytes) {
    Frame frame;
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::transform(bytes.begin(), bytes.end(), frame.data.begin(),
                   [](int byte) { return static_cast<std::uint8_t>(byte); });
    return frame;
}

Field field_at(int start, int length, ByteOrder order,
               FieldKind kind = FieldKind::unsigned_integer) {
    Field field;
    field.start_bit = start;
    field.length = length;
    field.order = order;
    field.kind = kind;
    return field;
}

Field scaled(Field field, double scale, double offset) {
    field.scale = scale;
    field.offset = offset;
    return field;
}

// The model: the numbers of a field's bits, the least significant first, as a DBC counts them.
// Motorola fields go down within a byte and on at the highest bit of the next.
std::vector<int> bits_of(const Field& field) {
    std::vector<int> bits;
    for (int i = 0, bit = field.start_bit; i < field.length; ++i) {
        bits.push_back(bit);
        if (field.order == little)
            ++bit;
        else
            bit = bit % 8 == 0 ? bit + 15 : bit - 1;
    }
    if (field.order == big) std::reverse(bits.begin(), bits.end());
    return bits;
}

bool bit_of(const Frame& frame, int bit) {
    return (frame.data[static_cast<size_t>(bit / 8)] >> bit % 8 & 1) != 0;
}

std::uint64_t model_raw(const Field& field, const Frame& frame) {
    std::uint64_t raw = 0;
    int place = 0;
    for (const int bit : bits_of(field))
        raw |= std::uint64_t{bit_of(frame, bit)} << place++;
    if (field.kind == FieldKind::signed_integer && bit_of(frame, bits_of(field).back()))
        for (; place < 64; ++place)
            raw |= std::uint64_t{1} << place;
    return raw;
}

int model_bytes(const Field& field) {
    const auto bits = bits_of(field);
    return *std::max_element(bits.begin(), bits.end()) / 8 + 1;
}

class Draw {
  public:
    explicit Draw(unsigned start) : engine_(start) {}
    int integer(int lowest, int highest) {
        return std::uniform_int_distribution<int>(lowest, highest)(engine_);
    }
    std::uint64_t bits() { return engine_(); }
    Frame frame() {
        Frame frame;
        frame.length = 64;
        for (auto& byte : frame.data)
            byte = static_cast<std::uint8_t>(engine_());
        return frame;
    }
    // Without fault in 64 bytes.
    Field field() {
        for (;;) {
            const auto kind = static_cast<FieldKind>(integer(0, 3));
            int length = integer(1, 64);
            if (kind == FieldKind::float32) length = 32;
            if (kind == FieldKind::float64) length = 64;
            const Field drawn =
                field_at(integer(0, 511), length, integer(0, 1) ? big : little, kind);
            if (model_bytes(drawn) <= 64) return drawn;
        }
    }

  private:
    std::mt19937_64 engine_;
};

std::string shown(const Field& field) {
    return std::to_string(field.start_bit) + "|" + std::to_string(field.length) +
           (field.order == big ? "@0" : "@1") + " kind " +
           std::to_string(static_cast<int>(field.kind));
}

// --- known bytes, known values -----------------------------------------------------------------

// The message of cantools' introduction: three Motorola signals, one of them over three bytes.
TEST(CanField, Motohawk) {
    const Frame frame = frame_with({0xc0, 0x06, 0xe0, 0, 0, 0, 0, 0});
    const Field temperature = scaled(field_at(0, 12, big, FieldKind::signed_integer), 0.01, 250);
    EXPECT_EQ(raw_of(temperature, frame), 55);
    EXPECT_DOUBLE_EQ(value_of(temperature, frame), 250.55);
    EXPECT_DOUBLE_EQ(value_of(scaled(field_at(6, 6, big), 0.1, 0), frame), 3.2);
    EXPECT_EQ(value_of(field_at(7, 1, big), frame), 1);
}

// SAE J1939-71: engine speed is SPN 190, bytes 4 and 5, 0.125 rpm a bit; coolant temperature
// SPN 110, one byte, -40 degC at 0.
TEST(CanField, J1939) {
    const Frame engine = frame_with({0xff, 0xff, 0xff, 0x68, 0x13, 0xff, 0xff, 0xff});
    EXPECT_EQ(value_of(scaled(field_at(24, 16, little), 0.125, 0), engine), 621);
    const Frame coolant = frame_with({0x7d, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(value_of(scaled(field_at(0, 8, little), 1, -40), coolant), 85);
}

// CiA 402 in a PDO: status word 0x1637, position -10000 counts, both Intel.
TEST(CanField, DrivePdo) {
    const Frame frame = frame_with({0x37, 0x16, 0xf0, 0xd8, 0xff, 0xff});
    EXPECT_EQ(raw_of(field_at(0, 16, little), frame), 0x1637);
    EXPECT_EQ(raw_of(field_at(16, 32, little, FieldKind::signed_integer), frame), -10000);
}

TEST(CanField, SameBytesInBothOrders) {
    const Frame frame = frame_with({0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc, 0xde, 0xf0});
    EXPECT_EQ(raw_of(field_at(0, 16, little), frame), 0x3412);
    EXPECT_EQ(raw_of(field_at(7, 16, big), frame), 0x1234);
    EXPECT_EQ(raw_of(field_at(39, 16, big), frame), 0x9abc);
    EXPECT_EQ(raw_of(field_at(3, 8, big), frame), 0x23); // the low half, then the next high half
    EXPECT_EQ(raw_of(field_at(4, 8, little), frame), 0x41);
    EXPECT_EQ(static_cast<std::uint64_t>(raw_of(field_at(7, 64, big), frame)), 0x123456789abcdef0u);
    EXPECT_EQ(static_cast<std::uint64_t>(raw_of(field_at(0, 64, little), frame)),
              0xf0debc9a78563412u);
}

TEST(CanField, OneBitIsTheSameInBothOrders) {
    const Frame frame = Draw(seed).frame();
    for (int bit = 0; bit < 512; ++bit) {
        EXPECT_EQ(raw_of(field_at(bit, 1, little), frame), bit_of(frame, bit));
        EXPECT_EQ(raw_of(field_at(bit, 1, big), frame), bit_of(frame, bit));
        EXPECT_EQ(raw_of(field_at(bit, 1, big, FieldKind::signed_integer), frame),
                  -int{bit_of(frame, bit)});
    }
}

TEST(CanField, Floats) {
    const Frame one = frame_with({0, 0, 0x80, 0x3f, 0xc0, 0x20, 0, 0});
    EXPECT_EQ(value_of(field_at(0, 32, little, FieldKind::float32), one), 1.0);
    EXPECT_EQ(value_of(field_at(39, 32, big, FieldKind::float32), one), -2.5);
    const Frame pi = frame_with({0x40, 0x09, 0x21, 0xfb, 0x54, 0x44, 0x2d, 0x18});
    EXPECT_EQ(value_of(field_at(7, 64, big, FieldKind::float64), pi), 3.141592653589793);
    const Frame nan = frame_with({0, 0, 0xc0, 0x7f});
    EXPECT_TRUE(std::isnan(value_of(field_at(0, 32, little, FieldKind::float32), nan)));
}

TEST(CanField, LongestIntegers) {
    Frame frame = frame_with({255, 255, 255, 255, 255, 255, 255, 255});
    EXPECT_EQ(value_of(field_at(0, 64, little), frame), 18446744073709551615.0);
    EXPECT_EQ(value_of(field_at(7, 64, big, FieldKind::signed_integer), frame), -1);
    frame.data[7] = 0x7f;
    const Field whole = field_at(0, 64, little, FieldKind::signed_integer);
    EXPECT_EQ(raw_of(whole, frame), std::numeric_limits<std::int64_t>::max());
    put_raw(whole, std::numeric_limits<std::int64_t>::min(), frame);
    EXPECT_EQ(raw_of(whole, frame), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(frame.data[7], 0x80);
}

TEST(CanField, NineBytes) { // 64 bits that begin within a byte
    Frame frame;
    put_raw(field_at(3, 64, little), -1, frame);
    EXPECT_EQ(frame.data[0], 0xf8);
    EXPECT_EQ(frame.data[8], 0x07);
    EXPECT_EQ(raw_of(field_at(3, 64, little), frame), -1);
    frame = {};
    put_raw(field_at(3, 64, big), -1, frame);
    EXPECT_EQ(frame.data[0], 0x0f);
    EXPECT_EQ(frame.data[8], 0xf0);
    EXPECT_EQ(raw_of(field_at(3, 64, big), frame), -1);
}

// --- any field against the model ---------------------------------------------------------------

TEST(CanField, RandomFieldsAgreeWithTheModel) {
    constexpr int rounds = 50'000;
    std::printf("figure: %d random fields in 64 bytes as the bit model has them (seed %u)\n",
                rounds, seed);
    Draw draw(seed);
    for (int i = 0; i < rounds; ++i) {
        const Field field = draw.field();
        const Frame frame = draw.frame();
        ASSERT_EQ(static_cast<std::uint64_t>(raw_of(field, frame)), model_raw(field, frame))
            << shown(field) << ", round " << i;
    }
}

TEST(CanField, PutIsTheInverseAndLeavesOtherBits) {
    Draw draw(seed + 1);
    for (int i = 0; i < 50'000; ++i) {
        const Field field = draw.field();
        const Frame before = draw.frame();
        Frame after = before;
        put_raw(field, raw_of(field, before), after);
        ASSERT_EQ(after.data, before.data) << shown(field) << ", round " << i;

        // bits above the field's length are cut off
        const std::uint64_t written = draw.bits();
        put_raw(field, static_cast<std::int64_t>(written), after);
        Frame expected = before;
        int place = 0;
        for (const int bit : bits_of(field)) {
            auto& byte = expected.data[static_cast<size_t>(bit / 8)];
            byte = static_cast<std::uint8_t>((byte & ~(1 << bit % 8)) |
                                             static_cast<int>(written >> place++ & 1) << bit % 8);
        }
        ASSERT_EQ(after.data, expected.data)
            << shown(field) << ", round " << i << ", seed " << seed + 1;
    }
}

TEST(CanField, ValuesAreThoseOfTheRawNumber) {
    Draw draw(seed + 2);
    for (int i = 0; i < 20'000; ++i) {
        const Field field = scaled(draw.field(), 0.25, -3);
        const Frame frame = draw.frame();
        const std::uint64_t raw = model_raw(field, frame);
        double number = 0;
        if (field.kind == FieldKind::unsigned_integer) number = static_cast<double>(raw);
        if (field.kind == FieldKind::signed_integer)
            number = static_cast<double>(static_cast<std::int64_t>(raw));
        if (field.kind == FieldKind::float32)
            number = std::bit_cast<float>(static_cast<std::uint32_t>(raw));
        if (field.kind == FieldKind::float64) number = std::bit_cast<double>(raw);
        const double value = value_of(field, frame);
        if (std::isnan(number))
            ASSERT_TRUE(std::isnan(value)) << shown(field);
        else
            ASSERT_EQ(value, number * 0.25 - 3) << shown(field) << ", seed " << seed + 2;
    }
}

// --- where fields lie --------------------------------------------------------------------------

TEST(CanField, BytesNeededAndFaultAreExactForEveryField) {
    for (const ByteOrder order : {little, big})
        for (int start = 0; start < 512; ++start)
            for (int length = 1; length <= 64; ++length) {
                const Field field = field_at(start, length, order);
                const int bytes = model_bytes(field);
                ASSERT_EQ(bytes_needed(field), bytes) << shown(field);
                ASSERT_EQ(fault_of(field, bytes), "") << shown(field);
                ASSERT_NE(fault_of(field, bytes - 1), "") << shown(field);
            }
}

// The bits of a field of the first four bytes.
std::bitset<32> cover_of(const Field& field) {
    std::bitset<32> cover;
    for (const int bit : bits_of(field))
        cover.set(static_cast<size_t>(bit));
    return cover;
}

TEST(CanField, OverlapIsExactForEveryPairInFourBytes) {
    std::vector<Field> fields;
    std::vector<std::bitset<32>> covers;
    for (const ByteOrder order : {little, big})
        for (int start = 0; start < 32; ++start)
            for (int length = 1; length <= 32; ++length) {
                const Field field = field_at(start, length, order);
                if (model_bytes(field) > 4) continue;
                fields.push_back(field);
                covers.push_back(cover_of(field));
            }
    long wrong = 0;
    for (size_t a = 0; a < fields.size(); ++a)
        for (size_t b = 0; b < fields.size(); ++b)
            wrong += overlap(fields[a], fields[b]) != (covers[a] & covers[b]).any();
    EXPECT_EQ(wrong, 0) << "of " << fields.size() * fields.size() << " pairs";
    EXPECT_GT(fields.size(), 1000u);
}

TEST(CanField, OverlapIsExactForRandomPairsInSixtyFourBytes) {
    Draw draw(seed + 3);
    int shared = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Field a = draw.field(), b = draw.field();
        const auto bits = bits_of(a), others = bits_of(b);
        const bool share = std::any_of(bits.begin(), bits.end(), [&](int bit) {
            return std::find(others.begin(), others.end(), bit) != others.end();
        });
        ASSERT_EQ(overlap(a, b), share) << shown(a) << " and " << shown(b) << ", seed " << seed + 3;
        shared += share;
    }
    EXPECT_GT(shared, 1000);
}

TEST(CanField, FieldsOfDifferentFramesDoNotOverlap) {
    const Field a = field_at(0, 8, little);
    Field b = a;
    EXPECT_TRUE(overlap(a, b));
    b.frame.extended = true;
    EXPECT_FALSE(overlap(a, b));
}

TEST(CanField, FaultsInWords) {
    EXPECT_EQ(fault_of(field_at(56, 16, little), 8), "bits 56…71 leave a frame of 8 bytes");
    EXPECT_EQ(fault_of(field_at(56, 9, big), 8),
              "9 bits from bit 56 on, big endian, leave a frame of 8 bytes");
    EXPECT_EQ(fault_of(field_at(0, 0, little), 8), "0 bits; expected 1…64");
    EXPECT_EQ(fault_of(field_at(0, 65, little), 64), "65 bits; expected 1…64");
    EXPECT_EQ(fault_of(field_at(0, 16, little, FieldKind::float32), 8),
              "a 32-bit float has 16 bits; expected 32");
    EXPECT_EQ(fault_of(field_at(0, 32, little, FieldKind::float64), 8),
              "a 64-bit float has 32 bits; expected 64");
    EXPECT_EQ(fault_of(field_at(-1, 8, little), 8), "start bit -1; expected 0…511");
    EXPECT_EQ(fault_of(field_at(512, 1, big), 64), "start bit 512; expected 0…511");
    EXPECT_EQ(fault_of(field_at(std::numeric_limits<int>::max(), 64, little), 64),
              "start bit 2147483647; expected 0…511");
}

} // namespace
