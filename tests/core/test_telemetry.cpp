#include "support.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace {

std::vector<uint8_t> bytes(const sid_can_frame_t& frame) {
    return {frame.data, frame.data + frame.length};
}

struct Ring {
    std::vector<sid_row_t> rows;
    sid_telemetry_t telemetry{};
    explicit Ring(uint32_t count) : rows(count) {
        EXPECT_TRUE(sid_telemetry_init(&telemetry, rows.data(), count));
    }
    void push(uint32_t position, int32_t torque, int32_t reference) {
        const sid_sample_t in = {position, torque};
        sid_telemetry_push(&telemetry, &in, reference);
    }
};

} // namespace

// The bytes of SPEC.md, "Telemetry", written down by hand.
TEST(Telemetry, SamplesAreTheBytesOfTheSpecification) {
    Ring ring(16);
    ring.push(0x11223344U, 0x123456, -2);
    ring.push(0xFFFFFFFFU, -1, 0x01020304);
    sid_can_frame_t frame;
    EXPECT_FALSE(sid_telemetry_pack(&ring.telemetry, 1, false, &frame)) << "no five rows yet";
    ASSERT_TRUE(sid_telemetry_pack(&ring.telemetry, 3, true, &frame));
    std::vector<uint8_t> expected = {
        1,    2,    0,    0,    0,    0,    0,    0,                      // header
        0x44, 0x33, 0x22, 0x11, 0xFE, 0xFF, 0xFF, 0xFF, 0x56, 0x34, 0x12, // first row
        0xFF, 0xFF, 0xFF, 0xFF, 0x04, 0x03, 0x02, 0x01, 0xFF, 0xFF, 0xFF};
    expected.resize(64);
    expected[63] = 3;
    EXPECT_EQ(bytes(frame), expected);
    EXPECT_TRUE(frame.fd);
    for (uint32_t k = 0; k < 5; k++)
        ring.push(k, int32_t(k), 0);
    ASSERT_TRUE(sid_telemetry_pack(&ring.telemetry, 0, false, &frame));
    EXPECT_EQ(sid_get_u16(&frame.data[2]), 1) << "sequence";
    EXPECT_EQ(sid_get_u32(&frame.data[4]), 2U) << "tick of the first row";
}

TEST(Telemetry, ADescriptionIsTheBytesOfTheSpecification) {
    Ring ring(16);
    sid_axis_t axis{};
    axis.sample_rate_uHz = 8000000000U; // 0x0000000'1DCD65000
    axis.rated_torque = {0x51893A2B, -31};
    axis.count = {0x6487ED51, -45};
    axis.linear = true;
    const sid_run_t run = {0x01020304U, 0x05060708U, 0x0A0B0C0DU, 17, 2, SID_TORQUE_HELD_LAST};
    sid_can_frame_t frame;
    sid_telemetry_describe(&ring.telemetry, &axis, &run, &frame);
    const std::vector<uint8_t> expected = {
        2,    1,    0,    0,    0,    0,    0,    0,    0x00, 0x50, 0xD6, 0xDC, 0x01, 0, 0, 0,
        0x2B, 0x3A, 0x89, 0x51, 0xE1, 0xFF, 0xD3, 0xFF, 0x51, 0xED, 0x87, 0x64, 0,    0, 0, 0,
        4,    3,    2,    1,    8,    7,    6,    5,    0x0D, 0x0C, 0x0B, 0x0A, 17,   2, 2, 1};
    EXPECT_EQ(bytes(frame), expected);
}

TEST(Telemetry, TorqueIsClampedTo24Bits) {
    for (const auto& [torque, expected] : {std::pair{INT32_MAX, 0x7FFFFFU},
                                           {INT32_MIN, 0x800001U},
                                           {1 << 23, 0x7FFFFFU},
                                           {(1 << 23) - 1, 0x7FFFFFU}}) {
        Ring ring(16);
        ring.push(0, torque, 0);
        sid_can_frame_t frame;
        ASSERT_TRUE(sid_telemetry_pack(&ring.telemetry, 0, true, &frame));
        EXPECT_EQ(sid_get_u16(&frame.data[16]) | uint32_t(frame.data[18]) << 16, expected);
    }
}

// Whatever the pauses of the background: rows that were packed are right, the others are counted.
TEST(Telemetry, RowsThatWereLostAreCountedAndTicksJump) {
    std::mt19937 random(seed_of("telemetry"));
    Ring ring(64);
    uint32_t pushed = 0, packed = 0;
    sid_can_frame_t frame;
    for (int round = 0; round < 2000; round++) {
        const uint32_t burst = random() % (round % 10 == 0 ? 200 : 20);
        for (uint32_t i = 0; i < burst; i++, pushed++)
            ring.push(pushed, int32_t(pushed & 0xFFFF), int32_t(3 * pushed));
        while (sid_telemetry_pack(&ring.telemetry, 0, false, &frame)) {
            const uint32_t tick = sid_get_u32(&frame.data[4]);
            for (uint32_t i = 0; i < frame.data[1]; i++, packed++) {
                ASSERT_EQ(sid_get_u32(&frame.data[8 + 11 * i]), tick + i);
                ASSERT_EQ(sid_get_u32(&frame.data[12 + 11 * i]), 3 * (tick + i));
            }
        }
    }
    EXPECT_GT(ring.telemetry.lost, 100U);
    EXPECT_EQ(packed + ring.telemetry.lost + (pushed - ring.telemetry.read), pushed);
}

TEST(Telemetry, ARingIsAPowerOfTwo) {
    sid_telemetry_t telemetry;
    std::vector<sid_row_t> rows(64);
    for (uint32_t count : {0U, 1U, 8U, 15U, 17U, 48U})
        EXPECT_FALSE(sid_telemetry_init(&telemetry, rows.data(), count)) << count;
    EXPECT_TRUE(sid_telemetry_init(&telemetry, rows.data(), 64));
    EXPECT_FALSE(sid_telemetry_init(&telemetry, nullptr, 64));
}
