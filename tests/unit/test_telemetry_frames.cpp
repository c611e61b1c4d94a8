// The core packs, the host unpacks: both ends bit for bit, and the captures that come of it.
#include "can/telemetry_table.hpp"
#include "common/error.hpp"
#include "node/core_frame.hpp"
#include "servoid/sid_stream.h"
#include "servoid/sid_telemetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace servoid::can {
namespace {

constexpr int kNode = 9;

Frame received(const sid_can_frame_t& frame) {
    Frame out = from_core(frame);
    out.id = telemetry_id(kNode).id;
    return out;
}

// A drive's telemetry without a drive: rows as they are given, packed by the core.
struct Drive {
    std::vector<sid_row_t> ring = std::vector<sid_row_t>(1024);
    sid_telemetry_t telemetry{};
    sid_axis_t axis{};
    sid_run_t run{};
    std::vector<Frame> frames;

    explicit Drive(int bits = 32, int shift = 0,
                   sid_torque_timing_t timing = SID_TORQUE_HELD_LAST) {
        sid_telemetry_init(&telemetry, ring.data(), 1024);
        axis.sample_rate_uHz = 8000000000U;
        axis.rated_torque = {0x40000000, -29}; // 2 N·m
        axis.count = {0x40000000, -40};        // 2^-10 rad
        run.position_bits = std::uint8_t(bits);
        run.position_shift = std::uint8_t(shift), run.torque_timing = std::uint8_t(timing);
    }
    void describe() {
        sid_can_frame_t frame;
        sid_telemetry_describe(&telemetry, &axis, &run, &frame);
        frames.push_back(received(frame));
    }
    void row(std::uint32_t position, std::int32_t reference_q8, std::int32_t torque) {
        const sid_sample_t sample = {position, torque};
        sid_telemetry_push(&telemetry, &sample, reference_q8);
        send(false);
    }
    void send(bool flush) {
        sid_can_frame_t frame;
        while (sid_telemetry_pack(&telemetry, 1, flush, &frame))
            frames.push_back(received(frame));
    }
    // A run of so many rows: a ramp, the torque of a row known from its number.
    void ramp(int rows) {
        run.start_tick = std::max<std::uint32_t>(std::uint32_t(telemetry.written), 1),
        run.end_tick = 0;
        run.start_raw = 0;
        describe();
        for (int k = 0; k < rows; ++k)
            row(std::uint32_t(k), 256 * k, k << 8);
    }
};

BusCaptures captures_of(const std::vector<Frame>& frames) {
    TelemetryTable table(kNode);
    for (const Frame& frame : frames)
        table.add(frame);
    return table.captures("bus");
}

} // namespace

TEST(TelemetryFrames, RowsComeOutAsTheyWentIn) {
    std::mt19937 random(7);
    Drive drive;
    std::vector<TelemetryRow> sent, got;
    for (int k = 0; k < 5000; ++k) {
        const auto torque = std::int32_t(random() % 0x1000000) - 0x800000;
        const TelemetryRow r = {std::uint32_t(random()), std::int32_t(random()),
                                std::max(torque, -0x7FFFFF)};
        sent.push_back(r);
        drive.row(r.position_raw, r.reference_q8, r.torque_pu_q20);
    }
    drive.send(true);
    std::uint16_t sequence = 0;
    for (const Frame& frame : drive.frames) {
        const Telemetry told = decode_telemetry(frame);
        const auto* samples = std::get_if<TelemetrySamples>(&told);
        ASSERT_TRUE(samples);
        EXPECT_EQ(samples->sequence, sequence++);
        EXPECT_EQ(samples->tick, got.size());
        EXPECT_EQ(samples->state, 1);
        for (int i = 0; i < samples->rows; ++i)
            got.push_back(samples->row[std::size_t(i)]);
    }
    EXPECT_EQ(got, sent);
}

TEST(TelemetryFrames, ADescriptionSaysWhatTheDriveIs) {
    Drive drive(17, 3, SID_TORQUE_SAMPLED);
    drive.axis.linear = true;
    drive.run.start_tick = 0xFEDCBA98U, drive.run.end_tick = 0x01234567U;
    drive.run.start_raw = 0x89ABCDEFU;
    drive.describe();
    const Telemetry told = decode_telemetry(drive.frames.back());
    const auto* d = std::get_if<TelemetryDescription>(&told);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->sample_rate_uHz, 8000000000U);
    EXPECT_EQ(d->rated_torque, 2.0);
    EXPECT_EQ(d->count, std::ldexp(1, -10));
    EXPECT_EQ(d->start_tick, 0xFEDCBA98U);
    EXPECT_EQ(d->end_tick, 0x01234567U);
    EXPECT_EQ(d->start_raw, 0x89ABCDEFU);
    EXPECT_EQ(d->position_bits, 17);
    EXPECT_EQ(d->position_shift, 3);
    EXPECT_EQ(d->torque_timing, SID_TORQUE_SAMPLED);
    EXPECT_TRUE(d->linear);
}

TEST(TelemetryFrames, NonsenseIsNoTelemetry) {
    Drive drive;
    drive.describe();
    const Frame good = drive.frames.back();
    EXPECT_TRUE(std::holds_alternative<TelemetryDescription>(decode_telemetry(good)));
    const auto spoilt = [&](auto&& change) {
        Frame frame = good;
        change(frame);
        return std::holds_alternative<std::monostate>(decode_telemetry(frame));
    };
    EXPECT_TRUE(spoilt([](Frame& f) { f.length = 32; }));
    EXPECT_TRUE(spoilt([](Frame& f) { f.data[1] = 2; })) << "another version";
    EXPECT_TRUE(spoilt([](Frame& f) { f.data[44] = 0; })) << "an encoder without bits";
    EXPECT_TRUE(spoilt([](Frame& f) { f.data[46] = 3; })) << "an unknown timing";
    EXPECT_TRUE(spoilt([](Frame& f) { f.data[0] = 9; }));
    EXPECT_TRUE(spoilt([](Frame& f) { f.error = true; }));
    EXPECT_TRUE(spoilt([](Frame& f) { f.data[0] = 1, f.data[1] = 6, f.length = 64; }));
}

// The torque that a row carries was set one sample before: it belongs one row up.
TEST(TelemetryTable, ARunIsACaptureInSI) {
    Drive drive;
    drive.row(0, 0, 5); // idle
    drive.ramp(100);
    drive.send(true);
    const BusCaptures heard = captures_of(drive.frames);
    ASSERT_EQ(heard.captures.size(), 1u);
    const Capture& c = heard.captures.front();
    ASSERT_EQ(c.rows(), 99u);
    EXPECT_DOUBLE_EQ(c.sample_time_s, 125e-6);
    EXPECT_TRUE(c.torque.empty());
    for (std::size_t k = 0; k < c.rows(); ++k) {
        EXPECT_DOUBLE_EQ(c.position[k], std::ldexp(double(k), -10));
        EXPECT_DOUBLE_EQ(c.position_ref[k], std::ldexp(double(k), -10));
        EXPECT_NEAR(c.torque_ref[k], std::ldexp(double(k + 1), -11), 1e-15);
    }
}

TEST(TelemetryTable, TimingDecidesWhichTorqueItIs) {
    for (const auto timing : {SID_TORQUE_SAMPLED, SID_TORQUE_HELD_NEXT}) {
        Drive drive(32, 0, timing);
        drive.row(0, 0, 0);
        drive.ramp(50);
        const Capture c = captures_of(drive.frames).captures.front();
        const auto& torque = timing == SID_TORQUE_SAMPLED ? c.torque : c.torque_ref;
        ASSERT_EQ(torque.size(), c.rows());
        EXPECT_NEAR(torque[7], std::ldexp(7.0, -11), 1e-15);
    }
}

// An encoder of few bits that rolls over, session counts of four encoder counts, a start away from
// zero: position and reference stay together.
TEST(TelemetryTable, AnEncoderThatRollsOverIsUnwrapped) {
    Drive drive(12, 2);
    drive.row(4090, 0, 0);
    drive.run.start_tick = 1, drive.run.start_raw = 4090;
    drive.describe();
    for (int k = 0; k < 3000; ++k)
        drive.row(std::uint32_t(4090 + 8 * k) & 4095U, 256 * 2 * k, 0);
    const Capture c = captures_of(drive.frames).captures.front();
    for (std::size_t k = 0; k < c.rows(); k += 100) {
        EXPECT_DOUBLE_EQ(c.position[k] - c.position[0], std::ldexp(8.0 * double(k), -10));
        EXPECT_DOUBLE_EQ(c.position_ref[k], c.position[k]);
    }
}

// Lost, repeated and late frames: counted, and every row that came is where it belongs.
TEST(TelemetryTable, FramesThatAreLostRepeatedOrLate) {
    std::mt19937 random(11);
    Drive drive;
    drive.row(0, 0, 0);
    drive.ramp(20000);
    drive.send(true);
    std::vector<Frame> heard;
    long lost = 0, repeated = 0, swapped = 0;
    for (std::size_t i = 0; i < drive.frames.size(); ++i) {
        const bool data = drive.frames[i].data[0] == 1;
        if (data && random() % 100 == 0) {
            lost += drive.frames[i].data[1];
            continue;
        }
        heard.push_back(drive.frames[i]);
        if (data && random() % 50 == 0) heard.push_back(drive.frames[i]), repeated += 5;
        if (data && random() % 50 == 0 && heard.size() > 3 &&
            !(heard.back() == heard[heard.size() - 2]) && heard[heard.size() - 2].data[0] == 1)
            std::swap(heard.back(), heard[heard.size() - 2]), ++swapped;
    }
    const BusCaptures out = captures_of(heard);
    EXPECT_EQ(out.report.lost, lost);
    EXPECT_EQ(out.report.repeated, repeated);
    EXPECT_NEAR(double(out.report.reordered), double(swapped), double(swapped) * 0.3 + 5);
    EXPECT_GT(out.captures.size(), 10u);
    for (const Capture& c : out.captures)
        for (std::size_t k = 0; k < c.rows(); k += 7) {
            EXPECT_NEAR(c.torque_ref[k], (c.position[k] + std::ldexp(1, -10)) / 2, 1e-12);
            EXPECT_DOUBLE_EQ(c.position_ref[k], c.position[k]);
        }
}

TEST(TelemetryTable, TwoRunsAreTwoCapturesAndIdleTimeIsNone) {
    Drive drive;
    for (int run = 0; run < 2; ++run) {
        for (int k = 0; k < 3000; ++k)
            drive.row(0, 0, 77); // before, between
        drive.ramp(100 + run);
        drive.run.end_tick = drive.telemetry.written;
        drive.describe();
    }
    for (int k = 0; k < 3000; ++k)
        drive.row(0, 0, 77);
    const BusCaptures out = captures_of(drive.frames);
    ASSERT_EQ(out.captures.size(), 2u);
    EXPECT_EQ(out.captures[0].rows(), 100u + 400 - 1) << "and 50 ms of coming to rest";
    EXPECT_EQ(out.captures[1].rows(), 101u + 400 - 1);
}

TEST(TelemetryTable, AResetSplitsAndIsCounted) {
    Drive drive;
    drive.row(0, 0, 0);
    drive.ramp(500);
    Drive again;
    Frame boot;
    boot.id = heartbeat_id(kNode).id, boot.length = 1;
    again.row(0, 0, 0);
    again.ramp(300);
    std::vector<Frame> heard = drive.frames;
    heard.push_back(boot);
    heard.insert(heard.end(), again.frames.begin(), again.frames.end());
    const BusCaptures out = captures_of(heard);
    EXPECT_EQ(out.report.resets, 1);
    EXPECT_EQ(out.report.lost, 0);
    ASSERT_EQ(out.captures.size(), 2u);
    EXPECT_EQ(out.captures[1].position.back(), std::ldexp(297.0, -10));
}

TEST(TelemetryTable, TicksRollOver) {
    Drive drive;
    drive.telemetry.written = drive.telemetry.read = 0xFFFFFF00U;
    drive.ramp(1000);
    const BusCaptures out = captures_of(drive.frames);
    ASSERT_EQ(out.captures.size(), 1u);
    EXPECT_EQ(out.captures[0].rows(), 999u);
    EXPECT_EQ(out.report.lost, 0);
    EXPECT_EQ(out.report.resets, 0);
}

TEST(TelemetryTable, WhatIsMissingIsSaid) {
    TelemetryTable none(kNode);
    EXPECT_THROW(none.captures("bus"), FileError);
    Drive drive;
    for (int k = 0; k < 50; ++k)
        drive.row(0, 0, 0);
    EXPECT_THROW(captures_of(drive.frames), FileError) << "no description";
    Drive brief;
    brief.row(0, 0, 0);
    brief.ramp(10);
    EXPECT_THROW(captures_of(brief.frames), Refusal);
}

} // namespace servoid::can
