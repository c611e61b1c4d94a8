// Frames to rows: whole cycles only, gaps split, and every loss is counted.
#include "can/bus_table.hpp"
#include "common/error.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace servoid;
using namespace servoid::can;

namespace {

constexpr std::int64_t kPeriod_ns = 1000000;

Field field(const char* name, std::uint32_t id, int start, int length,
            FieldKind kind = FieldKind::signed_integer) {
    return {name, {id, false}, start, length, ByteOrder::little, kind, 1, 0};
}

MappedSignal signal(const char* name, std::uint32_t id, int start, int length) {
    return {name, *find_column(name), field(name, id, start, length)};
}

// Torque alone, at the start of its frame.
FrameMap one_frame() {
    FrameMap map;
    map.path = "map";
    map.signals = {signal("torque_permille", 0x181, 0, 16)};
    return map;
}

// Torque and position of one cycle in two frames, with or without a SYNC.
FrameMap two_frames(bool sync) {
    FrameMap map = one_frame();
    map.signals.push_back(signal("position_count", 0x281, 0, 32));
    if (sync) map.sync = FrameId{0x80, false};
    return map;
}

Frame frame(std::uint32_t id, std::int64_t time_ns, std::int64_t value, int bytes) {
    Frame out;
    out.id = id, out.time_ns = time_ns, out.length = std::uint8_t(bytes);
    for (int i = 0; i < bytes; ++i)
        out.data[std::size_t(i)] = std::uint8_t(std::uint64_t(value) >> (8 * i));
    return out;
}

using Sends = std::function<bool(const Frame&, long cycle)>;

// SYNC, torque = cycle, position = 10·cycle; `sends` says which are on the bus.
void play(BusTable& table, long cycles, const Sends& sends) {
    for (long k = 0; k < cycles; ++k)
        for (const Frame& f :
             {frame(0x80, k * kPeriod_ns, 0, 0), frame(0x181, k * kPeriod_ns + 50000, k, 2),
              frame(0x281, k * kPeriod_ns + 90000, 10 * k, 4)})
            if (sends(f, k)) table.add(f);
}

bool all(const Frame&, long) { return true; }

double value(const RawTable& table, Signal wanted, std::size_t row) {
    return table.find(wanted)->values.at(row);
}

} // namespace

TEST(BusTable, RowsAreCyclesOfEveryClock) {
    for (const bool sync : {true, false}) {
        const FrameMap map = two_frames(sync);
        BusTable table(map);
        play(table, 100, all);
        BusReport report;
        const auto tables = table.tables("log", report);
        ASSERT_EQ(tables.size(), 1u);
        ASSERT_EQ(tables[0].rows(), 100u);
        for (std::size_t i = 0; i < 100; ++i) {
            EXPECT_EQ(value(tables[0], Signal::torque, i), double(i));
            EXPECT_EQ(value(tables[0], Signal::position, i), 10.0 * double(i));
            EXPECT_NEAR(value(tables[0], Signal::time, i), 1e-3 * double(i), 1e-9);
        }
        EXPECT_EQ(report.clock, sync ? "SYNC" : "arrival");
        EXPECT_EQ(report.frames, 300);
        EXPECT_EQ(report.used, 200);
        EXPECT_EQ(report.lost + report.repeated + report.late + report.reordered, 0);
    }
}

// Nothing is put in place of what was not received, and no pair is torn.
TEST(BusTable, ALostFrameSplitsTheCapture) {
    for (const bool sync : {true, false})
        for (const std::uint32_t id : {0x181u, 0x281u}) {
            const FrameMap map = two_frames(sync);
            BusTable table(map);
            play(table, 100, [&](const Frame& f, long k) { return f.id != id || k != 40; });
            BusReport report;
            const auto tables = table.tables("log", report);
            ASSERT_EQ(tables.size(), 2u);
            EXPECT_EQ(tables[0].rows(), 40u);
            EXPECT_EQ(tables[1].rows(), 59u);
            EXPECT_EQ(report.lost, 1);
            for (const RawTable& t : tables)
                for (std::size_t i = 0; i < t.rows(); ++i)
                    EXPECT_EQ(value(t, Signal::position, i), 10 * value(t, Signal::torque, i));
        }
}

// A PC that plays a log: pauses of up to 20 cycles, then all that waited at once. Each SYNC is the
// next cycle, and nothing is lost.
TEST(BusTable, BurstsAreNoLoss) {
    FrameMap map = two_frames(true);
    map.period_s = 1e-3;
    BusTable bursts(map);
    std::int64_t now = 0;
    play(bursts, 2000, [&](Frame f, long k) {
        const long due = k / 20 * 20 + (k / 200 % 2 == 0 ? 19 : 0); // every other 0.2 s in bursts
        now = std::max({now + 2000, due * kPeriod_ns, k / 200 % 2 ? f.time_ns : 0});
        f.time_ns = now;
        bursts.add(f);
        return false;
    });
    BusReport report;
    const auto tables = bursts.tables("log", report);
    EXPECT_EQ(report.clock, "SYNC, counted");
    EXPECT_EQ(report.lost, 0);
    EXPECT_EQ(report.repeated, 0);
    ASSERT_EQ(tables.size(), 1u);
    ASSERT_EQ(tables[0].rows(), 2000u);
    for (std::size_t k = 0; k < 2000; k += 37) {
        EXPECT_EQ(value(tables[0], Signal::position, k), 10.0 * double(k));
        EXPECT_DOUBLE_EQ(value(tables[0], Signal::time, k), 1e-3 * double(k));
    }
}

TEST(BusTable, ARepeatedFrameIsCountedAndDropped) {
    const FrameMap map = two_frames(true);
    BusTable table(map);
    play(table, 100, [&](const Frame& f, long k) {
        if (f.id == 0x181 && k == 30) table.add(f);
        return true;
    });
    BusReport report;
    const auto tables = table.tables("log", report);
    EXPECT_EQ(report.repeated, 1);
    EXPECT_EQ(report.lost, 0);
    ASSERT_EQ(tables.size(), 1u);
    EXPECT_EQ(tables[0].rows(), 100u);
}

// It arrives after the next SYNC, before the next one of its own.
TEST(BusTable, ALateFrameStandsInItsOwnCycle) {
    const FrameMap map = two_frames(true);
    BusTable table(map);
    Frame late;
    play(table, 100, [&](const Frame& f, long k) {
        if (f.id == 0x281 && k == 50) {
            late = f, late.time_ns += 960000;
            return false;
        }
        if (f.id == 0x181 && k == 51) table.add(late);
        return true;
    });
    BusReport report;
    const auto tables = table.tables("log", report);
    EXPECT_EQ(report.late, 1);
    EXPECT_EQ(report.lost, 0);
    ASSERT_EQ(tables.size(), 1u);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(value(tables[0], Signal::position, i), 10.0 * double(i));
}

TEST(BusTable, ACounterPutsReorderedFramesBack) {
    FrameMap map = one_frame();
    map.counter = field("counter", 0x181, 16, 8, FieldKind::unsigned_integer);
    BusTable table(map);
    std::vector<Frame> frames;
    for (long k = 0; k < 600; ++k)
        frames.push_back(frame(0x181, k * kPeriod_ns, k | ((k & 0xFF) << 16), 3));
    std::swap(frames[300], frames[301]);
    frames.erase(frames.begin() + 500);
    for (const Frame& f : frames)
        table.add(f);
    BusReport report;
    const auto tables = table.tables("log", report);
    EXPECT_EQ(report.clock, "counter");
    EXPECT_EQ(report.reordered, 1);
    EXPECT_EQ(report.lost, 1);
    ASSERT_EQ(tables.size(), 2u);
    for (std::size_t i = 0; i < 500; ++i)
        EXPECT_EQ(value(tables[0], Signal::torque, i), double(i));
}

// The log's times are rough, the drive's are not.
TEST(BusTable, TheDrivesOwnTimeIsTheTime) {
    FrameMap map = one_frame();
    map.device_time = field("time", 0x181, 16, 16, FieldKind::unsigned_integer);
    map.device_time->scale = 1e-6;
    BusTable table(map);
    for (long k = 0; k < 500; ++k) // a cycle of 1.25 ms, said at 1 ms by the log
        table.add(frame(0x181, k * kPeriod_ns, k | (((k * 1250) & 0xFFFF) << 16), 4));
    BusReport report;
    const auto tables = table.tables("log", report);
    EXPECT_EQ(report.clock, "device time");
    EXPECT_NEAR(report.period_s, 1.25e-3, 1e-12);
    ASSERT_EQ(tables.size(), 1u);
    EXPECT_EQ(tables[0].rows(), 500u);
}

TEST(BusTable, WhatIsNotThereIsSaid) {
    const FrameMap map = two_frames(false);
    BusReport report;
    BusTable empty(map);
    EXPECT_THROW(empty.tables("log", report), FileError);
    BusTable shorter(map);
    for (long k = 0; k < 50; ++k)
        shorter.add(frame(0x181, k * kPeriod_ns, k, 2)),
            shorter.add(frame(0x281, k * kPeriod_ns, k, 3));
    try {
        shorter.tables("log", report);
        FAIL();
    } catch (const FileError& e) {
        EXPECT_NE(std::string(e.what()).find("long enough"), std::string::npos) << e.what();
    }
}

// A period that is no whole number of ticks must not drift into another cycle.
TEST(BusTable, ADeviceTimeMayBeCoarse) {
    FrameMap map = one_frame();
    map.device_time = field("time", 0x181, 16, 32, FieldKind::unsigned_integer);
    map.device_time->scale = 1e-6;
    BusTable table(map);
    for (long k = 0; k < 5000; ++k)
        table.add(frame(0x181, k * kPeriod_ns, k | (k * 1000 / 3) << 16, 6));
    BusReport report;
    const auto tables = table.tables("log", report);
    EXPECT_NEAR(report.period_s, 1e-3 / 3, 1e-9);
    EXPECT_EQ(report.lost, 0);
    ASSERT_EQ(tables.size(), 1u);
    EXPECT_EQ(tables[0].rows(), 5000u);
}

TEST(BusTable, OneFrameIsRefused) {
    FrameMap map = one_frame();
    map.device_time = field("time", 0x181, 16, 16, FieldKind::unsigned_integer);
    BusTable table(map);
    table.add(frame(0x181, 0, 1, 4));
    BusReport report;
    EXPECT_THROW(table.tables("log", report), Refusal);
}

// The clock of a logger that finds its date jumps by fifty years: a trillion cycles.
TEST(BusTable, AJumpOfTheClockIsAGapAndNoLoop) {
    for (const bool sync : {true, false}) {
        const FrameMap map = two_frames(sync);
        BusTable table(map);
        play(table, 100, [&](const Frame& f, long k) {
            Frame later = f;
            if (k >= 50) later.time_ns += 1577836800'000000000;
            table.add(later);
            return false;
        });
        BusReport report;
        const auto tables = table.tables("log", report);
        ASSERT_EQ(tables.size(), 2u);
        EXPECT_EQ(tables[0].rows() + tables[1].rows(), 100u);
    }
}
