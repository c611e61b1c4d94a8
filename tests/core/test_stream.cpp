#include "node_drive.hpp"

#include <numeric>

namespace {

struct Stream {
    std::vector<int32_t> ring = std::vector<int32_t>(64);
    sid_stream_t stream{};
    sid_excite_config_t guards{32, 0, 1000, 100000, 1 << 20};
    explicit Stream(uint32_t total) {
        EXPECT_TRUE(sid_stream_init(&stream, ring.data(), 64, &guards));
        EXPECT_TRUE(sid_stream_prepare(&stream, total));
    }
    bool receive(const std::vector<uint8_t>& data, uint8_t length = 64) {
        sid_can_frame_t frame{};
        frame.length = length;
        std::copy(data.begin(), data.end(), frame.data);
        return sid_stream_receive(&stream, &frame);
    }
    sid_command_t step(uint32_t position = 0, int32_t torque = 0) {
        const sid_sample_t in = {position, torque};
        sid_command_t out;
        sid_stream_step(&stream, &in, &out);
        return out;
    }
};

std::vector<int32_t> ramp(int count) {
    std::vector<int32_t> out(static_cast<size_t>(count));
    std::iota(out.begin(), out.end(), 100);
    return out;
}

} // namespace

// Frames lost, repeated and swapped at random, sent again from where the stream stands: what is
// played is the move, reference for reference.
TEST(Stream, WhatIsPlayedIsTheMoveWhateverHappensToTheFrames) {
    std::mt19937 random(seed_of("stream"));
    for (int round = 0; round < 50; round++) {
        const std::vector<int32_t> move = ramp(1 + int(random() % 400));
        Stream s(uint32_t(move.size()));
        std::vector<int32_t> played;
        while (played.size() < move.size()) {
            const uint32_t back = uint32_t(random() % 30), at = s.stream.filled;
            const uint32_t first =
                random() % 4 == 0 ? uint32_t(random() % move.size()) : at - std::min(at, back);
            const uint32_t count =
                std::min<uint32_t>(1 + uint32_t(random() % 14), uint32_t(move.size()) - first);
            if (count) s.receive(reference_frame(move, first, count));
            if (s.stream.running == 0 && sid_stream_is_ready(&s.stream)) {
                ASSERT_TRUE(sid_stream_start(&s.stream, 0, 1 << 30));
            }
            while (s.stream.running && s.stream.filled != s.stream.played)
                played.push_back(s.step().reference_q8);
        }
        ASSERT_EQ(played, move);
        EXPECT_TRUE(sid_stream_is_over(&s.stream));
        EXPECT_EQ(s.step().reference_q8, move.back()) << "the last one stays";
        EXPECT_EQ(s.stream.starved, 0);
    }
}

TEST(Stream, AReferenceThatHasNotComeHoldsTheAxisInThatSample) {
    const std::vector<int32_t> move = ramp(200);
    Stream s(200);
    for (uint32_t first = 0; first < 42; first += 14)
        ASSERT_TRUE(s.receive(reference_frame(move, first, 14)));
    ASSERT_TRUE(sid_stream_start(&s.stream, 7, 1 << 30));
    for (int k = 0; k < 42; k++)
        ASSERT_EQ(s.step(uint32_t(7 + k)).reference_q8, move[size_t(k)]);
    const sid_command_t out = s.step(60);
    EXPECT_LT(out.held, 0);
    EXPECT_EQ(out.reference_q8, (60 - 7) * 256) << "where it is measured to be";
    EXPECT_NE(s.stream.starved, 0);
    ASSERT_TRUE(s.receive(reference_frame(move, 42, 14)));
    EXPECT_LT(s.step(61).held, 0) << "too late is too late";
}

TEST(Stream, GuardsHoldInTheSampleThatTripsThem) {
    const std::vector<int32_t> move = ramp(14);
    const auto started = [&] {
        Stream s(14);
        EXPECT_TRUE(s.receive(reference_frame(move, 0, 14)));
        EXPECT_TRUE(sid_stream_start(&s.stream, 0, 1 << 20));
        return s;
    };
    Stream torque = started();
    torque.stream.references = torque.ring.data();
    EXPECT_LT(torque.step(0, (1 << 20) + 1).held, 0);
    EXPECT_EQ(sid_excite_trip(&torque.stream.guards), SID_TRIP_TORQUE);
    Stream jump = started();
    jump.stream.references = jump.ring.data();
    EXPECT_LT(jump.step(1001).held, 0);
    EXPECT_EQ(sid_excite_trip(&jump.stream.guards), SID_TRIP_JUMP);
    Stream abort = started();
    abort.stream.references = abort.ring.data();
    EXPECT_GE(abort.step().held, 0);
    sid_stream_abort(&abort.stream);
    EXPECT_LT(abort.step().held, 0);
}

TEST(Stream, StuckCountsOnlyWhileTheReferenceMoves) {
    std::vector<int32_t> move(40, 5000);
    Stream s(40);
    for (uint32_t first = 0; first < 40; first += 10)
        ASSERT_TRUE(s.receive(reference_frame(move, first, 10)));
    ASSERT_TRUE(sid_stream_start(&s.stream, 0, 1 << 18));
    for (int k = 0; k < 100; k++)
        ASSERT_GE(s.step(0, 1 << 17).held, 0) << "a torque that holds a load, " << k;
    std::iota(move.begin(), move.end(), 1);
    Stream moving(40);
    for (uint32_t first = 0; first < 40; first += 10)
        ASSERT_TRUE(moving.receive(reference_frame(move, first, 10)));
    ASSERT_TRUE(sid_stream_start(&moving.stream, 0, 1 << 18));
    int held_at = -1;
    for (int k = 0; k < 40 && held_at < 0; k++)
        if (moving.step(0, 1 << 17).held < 0) held_at = k;
    EXPECT_EQ(held_at, 2) << "beyond 2^18 with the third sample of 2^17";
    EXPECT_EQ(sid_excite_trip(&moving.stream.guards), SID_TRIP_STUCK);
}

TEST(Stream, MalformedFramesAreRefusedAndCounted) {
    const std::vector<int32_t> move = ramp(64);
    Stream s(64);
    std::vector<uint8_t> good = reference_frame(move, 0, 14);
    EXPECT_FALSE(s.receive(good, 60)) << "too short for fourteen";
    good[1] = 15;
    EXPECT_FALSE(s.receive(good));
    good[1] = 0;
    EXPECT_FALSE(s.receive(good));
    good[1] = 14, good[0] = 2;
    EXPECT_FALSE(s.receive(good)) << "another kind";
    EXPECT_FALSE(s.receive(reference_frame(move, 14, 14))) << "a gap";
    EXPECT_EQ(s.stream.refused, 5U);
    EXPECT_EQ(s.stream.filled, 0U);
    EXPECT_FALSE(sid_stream_start(&s.stream, 0, 1 << 30)) << "not ready";
    EXPECT_FALSE(sid_stream_prepare(&s.stream, 0));
}
