// The bus in memory, and a recording from it.
#include "can/bus_log.hpp"
#include "can/candump.hpp"
#include "can/memory_bus.hpp"
#include "can/record.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

using namespace servoid;
using namespace servoid::can;
using namespace std::chrono_literals;

namespace {

Frame frame_of(std::uint32_t id, std::uint8_t first = 0) {
    Frame frame;
    frame.id = id, frame.length = 8, frame.data[0] = first;
    return frame;
}

std::vector<Frame> all_of(Bus& bus) {
    std::vector<Frame> out;
    for (Frame frame; bus.receive(frame, 0s);)
        out.push_back(frame);
    return out;
}

FrameMap counted_map() {
    FrameMap map;
    map.path = "test";
    map.counter = Field{"counter", {0x181, false}, 0, 8};
    map.period_s = 1e-3;
    for (const auto& [name, bit] : {std::pair{"position_rad", 8}, std::pair{"torque_Nm", 16}})
        map.signals.push_back(
            {name,
             *find_column(name),
             {name, {0x181, false}, bit, 8, ByteOrder::little, FieldKind::signed_integer, 0.1, 0}});
    return map;
}

} // namespace

TEST(MemoryBus, EveryOtherEndReceivesInOneOrder) {
    std::int64_t now_ns = 0;
    MemoryBus wire([&] { return now_ns += 1000; });
    const auto a = wire.end(), b = wire.end(), c = wire.end();
    a->send(frame_of(1));
    b->send(frame_of(2));
    a->send(frame_of(3));
    const auto at_c = all_of(*c), at_b = all_of(*b), at_a = all_of(*a);
    ASSERT_EQ(at_c.size(), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(at_c[i].id, i + 1);
        EXPECT_EQ(at_c[i].time_ns, 1000 * (i + 1));
    }
    ASSERT_EQ(at_b.size(), 2u);
    ASSERT_EQ(at_a.size(), 1u);
    EXPECT_EQ(at_a[0].id, 2u);
    EXPECT_EQ(a->health().sent, 2);
    EXPECT_EQ(c->health().received, 3);
}

TEST(MemoryBus, WhatHasNoRoomIsDroppedAndCounted) {
    MemoryBus wire({}, 4);
    const auto a = wire.end(), b = wire.end();
    for (int i = 0; i < 10; ++i)
        a->send(frame_of(1));
    EXPECT_EQ(all_of(*b).size(), 4u);
    EXPECT_EQ(b->health().received, 4);
    EXPECT_EQ(b->health().dropped, 6);
}

TEST(MemoryBus, AnEndWaitsForTheOthersThread) {
    MemoryBus wire;
    const auto a = wire.end(), b = wire.end();
    std::thread other([&] {
        for (Frame frame; a->receive(frame, 10s) && frame.id != 0;)
            a->send(frame_of(frame.id + 1));
    });
    Frame frame;
    for (std::uint32_t id = 1; id < 1000; ++id) {
        b->send(frame_of(id));
        ASSERT_TRUE(b->receive(frame, 10s));
        ASSERT_EQ(frame.id, id + 1);
    }
    b->send(frame_of(0));
    other.join();
    EXPECT_FALSE(b->receive(frame, 1ms));
}

TEST(MemoryBus, ErrorFramesAreCountedByKind) {
    MemoryBus wire;
    const auto a = wire.end(), b = wire.end();
    for (auto [id, state] : {std::pair{0x40, 0}, std::pair{0x100, 0}, std::pair{4, 0x20}}) {
        Frame error = frame_of(std::uint32_t(id));
        error.error = true, error.data[1] = std::uint8_t(state);
        a->send(error);
    }
    EXPECT_EQ(all_of(*b).size(), 3u);
    EXPECT_EQ(b->health().error_frames, 3);
    EXPECT_EQ(b->health().bus_off, 1);
    EXPECT_EQ(b->health().restarted, 1);
    EXPECT_EQ(b->health().error_passive, 1);
}

// A live bus and the log of it are the same captures.
TEST(Recorder, TheTableAndTheLogHoldTheMappedFrames) {
    MemoryBus wire;
    const auto a = wire.end(), b = wire.end();
    for (std::uint8_t i = 0; i < 100; ++i) {
        Frame frame = frame_of(0x181, i);
        frame.data[1] = i, frame.data[2] = std::uint8_t(2 * i % 100);
        a->send(frame);
        a->send(frame_of(0x701));
    }
    Recorder recorder(counted_map(), "vcan0", true);
    RecordOptions options;
    options.idle_s = 0.06;
    bool begun = false;
    options.begun = [&] { begun = true; };
    recorder.run(*b, options);
    EXPECT_TRUE(begun);
    const BusCaptures live = recorder.table().captures("vcan0", {});
    ASSERT_EQ(live.captures.size(), 1u);
    EXPECT_EQ(live.captures[0].rows(), 100u);
    EXPECT_EQ(live.report.frames, 100);
    Collector again(counted_map());
    CandumpReader reader(recorder.log(), "log");
    for (Frame frame; reader.next(frame);)
        again.add(frame);
    const BusCaptures log = again.captures("log", {});
    ASSERT_EQ(log.captures.size(), 1u);
    EXPECT_EQ(log.captures[0].position, live.captures[0].position);
    EXPECT_EQ(log.captures[0].torque, live.captures[0].torque);
}

TEST(Recorder, SaysWhatItExpectedAndWhatItHeard) {
    MemoryBus wire;
    const auto a = wire.end(), b = wire.end();
    a->send(frame_of(0x701));
    Recorder recorder(counted_map(), "vcan0", true);
    RecordOptions options;
    options.wait_s = 0.05;
    try {
        recorder.run(*b, options);
        FAIL() << "nothing was said";
    } catch (const BusError& e) {
        EXPECT_NE(std::string(e.what()).find("no frame 0x181; heard: 0x701"), std::string::npos)
            << e.what();
    }
    EXPECT_EQ(recorder.log(), "");
}
