#include "node_drive.hpp"

// The same plan by the session alone and by frames: the same bits.
TEST(Node, ASessionOverFramesGivesTheSameBits) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.plan_one(100, 1, 1);
    d.run_out();
    ASSERT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_OK));

    NodeDrive alone; // one idle sample, as begin() takes
    const sid_loop_config_t c = paper_loop(alone.axis);
    ASSERT_TRUE(sid_loop_init(&alone.loop, &c));
    sid_loop_reset(&alone.loop, 0);
    alone.torque = sid_loop_step(&alone.loop, 0, 0);
    sid_identify_config_t config = alone.config.identify;
    config.plan = alone.plan.data(), config.plan_length = 1;
    alone.plan[0] = {increment_of(100), int32_t(std::lround(1 / alone.axis.count_rad() * 256))};
    sid_identify_t session;
    ASSERT_TRUE(sid_identify_init(&session, &config));
    ASSERT_TRUE(sid_identify_start(&session, 0));
    for (int k = 0; k < 40000 && sid_identify_poll(&session, 64) < SID_STATE_DONE; k++) {
        const sid_sample_t in = {alone.axis.raw(), alone.torque};
        sid_identify_step(&session, &in, &alone.command);
        alone.torque =
            sid_loop_step(&alone.loop, alone.command.reference_q8, int32_t(alone.axis.count()));
        alone.axis.advance(alone.torque / 1048576.0 * alone.axis.rated_Nm);
    }
    ASSERT_EQ(alone.results[0].reason, SID_OK);
    EXPECT_EQ(d.value_at(0x2A10, 4), uint32_t(alone.results[0].inertia.mantissa));
    EXPECT_EQ(d.value_at(0x2A10, 5), uint16_t(alone.results[0].inertia.exponent));
    EXPECT_EQ(d.value_at(0x2A10, 8), uint32_t(alone.results[0].viscous.mantissa));
    const double error = d.axis.inertia_of(d.results[0].inertia) / d.axis.inertia_kgm2 - 1;
    EXPECT_NEAR(error, 0, 0.015);
}

// The reference stops in the period in which the heartbeat's time is over, at every phase of the
// sine, and the axis comes to rest; the background need not live for it.
TEST(Node, ALostMasterStopsTheReferenceInTime) {
    for (int after = 200; after < 360; after += 13) {
        NodeDrive d;
        ASSERT_TRUE(d.begin());
        d.plan_one(100, 0.1, 1);
        d.step(after);
        const uint32_t last_heard = d.node.master_seen;
        const int32_t before = d.command.reference_q8;
        for (int k = 0; k < 2000; k++)
            d.interrupt(); // no background, no heartbeat
        EXPECT_LT(d.command.held, 0);
        EXPECT_EQ(d.node.held_tick - last_heard, 100U * 8U + 1U) << "100 ms at 8 kHz";
        const int32_t held = d.command.reference_q8;
        EXPECT_NE(held, before);
        const double speed = std::fabs(d.axis.speed_rad_s);
        EXPECT_LT(speed, 1e-3);
        d.background();
        EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_MASTER_LOST));
        EXPECT_EQ(d.value_at(0x2A02, 1), uint32_t(SID_STATE_ABORTED));
        EXPECT_EQ(d.command.reference_q8, held);
    }
}

TEST(Node, AHeartbeatOfAnotherOneDoesNotCount) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.plan_one(20, 0.1, 1);
    for (int k = 0; k < 1600 && sid_node_is_running(&d.node); k++) {
        d.step(1, false);
        d.give(SID_ID_HEARTBEAT + 126, {5});
    }
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_MASTER_LOST));
}

TEST(Node, GuardsActInTheSample) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    ASSERT_EQ(d.write(0x2A04, 2, 900, 4), 0U) << "stroke, counts";
    d.plan_one(20, 1, 1);
    int held = -1;
    for (int k = 0; k < 4000 && held < 0; k++) {
        d.step(1);
        if (d.command.held < 0) held = k;
    }
    ASSERT_GE(held, 0);
    EXPECT_LE(std::abs(d.command.reference_q8), 256 * 1000) << "at the sample beyond 900";
    d.run_out(10);
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_ABORTED_STROKE));
    EXPECT_EQ(d.value_at(0x2A08, 3), 1U);
    d.step(2000);
    EXPECT_LT(std::fabs(d.axis.speed_rad_s), 1e-3);
}

// After an abort away from zero the next run begins where the axis stands, without a jump.
TEST(Node, TheNextRunBeginsWhereTheAxisStands) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.plan_one(20, 0.5, 1);
    d.step(700);
    ASSERT_EQ(d.write(0x2A01, 5, 1, 1), 0U);
    d.run_out(10);
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_ABORTED_BY_USER));
    d.step(4000);
    const auto absolute = [&] {
        return int32_t(d.node.run.start_raw << 8) + d.command.reference_q8;
    };
    const int32_t stands = absolute();
    ASSERT_GT(std::abs(stands), 500 * 256);
    ASSERT_EQ(d.write(0x2A01, 4, 2, 4), 0U);
    int32_t last = stands;
    for (int k = 0; k < 100; k++) {
        d.step(1);
        EXPECT_LT(std::abs(absolute() - last), 40 * 256 * 20) << k;
        if (k < 2) {
            EXPECT_LT(std::abs(absolute() - stands), 256 * 200) << k;
        }
        last = absolute();
    }
    d.run_out();
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_OK));
}

// A start that cannot be, after an abort away from zero: the axis is held where it is.
TEST(Node, AStartThatIsRefusedMovesNothing) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.plan_one(20, 0.5, 1);
    d.step(700);
    ASSERT_EQ(d.write(0x2A01, 5, 1, 1), 0U);
    d.run_out(10);
    const int32_t stands = d.command.reference_q8;
    ASSERT_NE(stands, 0);
    ASSERT_EQ(d.write(0x2A05, 1, 1000, 4), 0U) << "a window of 2000 s";
    EXPECT_EQ(d.write(0x2A01, 4, 2, 4), SID_SDO_STATE);
    d.step(10);
    EXPECT_EQ(d.command.reference_q8, stands);
    EXPECT_LT(d.command.held, 0);
}

// A log is complete in itself: the description comes before the first row of a run, and again.
TEST(Node, ADescriptionComesFirstAndAgain) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.write(0x2A01, 6, 1, 1), 0U);
    d.step(20);
    d.sent.clear();
    d.plan_one(10, 0.1, 1);
    d.run_out();
    d.background();
    int descriptions = 0, frames = 0, most = 0;
    uint32_t end = 0;
    for (const sid_can_frame_t& f : d.sent) {
        if (f.id != SID_ID_TELEMETRY + 5 || f.data[0] == SID_FRAME_PROGRESS) continue;
        if (f.data[0] == SID_FRAME_DESCRIPTION) {
            EXPECT_EQ(sid_get_u32(&f.data[32]), d.node.run.start_tick);
            EXPECT_EQ(f.data[44], 17) << "bits";
            end = sid_get_u32(&f.data[36]);
            descriptions++, frames = 0;
        } else if (descriptions == 0) {
            EXPECT_LE(sid_get_u32(&f.data[4]) + f.data[1], d.node.run.start_tick + 1);
        }
        most = std::max(most, ++frames);
    }
    EXPECT_GE(descriptions, 2);
    EXPECT_LE(most, 1024);
    EXPECT_EQ(end, d.node.run.end_tick) << "the last one tells the end";
    EXPECT_GT(end, d.node.run.start_tick);
}

TEST(Node, AStreamedMoveIsPlayedAndTold) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    std::vector<int32_t> move;
    for (int k = 0; k < 3000; k++) // half a turn and back, smooth
        move.push_back(int32_t(std::lround(65536 * 128 * (1 - std::cos(2 * M_PI * k / 3000)) / 2)));
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    ASSERT_EQ(d.write(0x2A01, 6, 1, 1), 0U);
    ASSERT_EQ(d.write(0x2A01, 3, 3000, 4), 0U);
    EXPECT_EQ(d.write(0x2A01, 4, 1, 4), SID_SDO_STATE) << "nothing to play yet";
    std::vector<int32_t> told;
    for (int k = 0; k < 4000; k++) {
        if (d.node.stream.filled < 3000 && k % 10 == 0)
            d.give(SID_ID_REFERENCES + 5,
                   reference_frame(move, d.node.stream.filled,
                                   std::min(14U, 3000 - d.node.stream.filled)));
        if (k == 800) {
            ASSERT_EQ(d.write(0x2A01, 4, 1, 4), 0U);
            d.sent.clear();
        }
        d.step(1);
        if (k > 800 && !sid_node_is_running(&d.node)) break;
    }
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_OK));
    const uint32_t start = d.value_at(0x2A02, 10);
    for (const sid_can_frame_t& f : d.sent)
        if (f.id == SID_ID_TELEMETRY + 5 && f.data[0] == SID_FRAME_SAMPLES)
            for (uint32_t i = 0; i < f.data[1]; i++)
                if (sid_get_u32(&f.data[4]) + i - start < 3000)
                    told.push_back(int32_t(sid_get_u32(&f.data[12 + 11 * i])));
    move.resize(told.size()); // the last frame is not full yet
    EXPECT_GT(told.size(), 2990U);
    EXPECT_EQ(told, move);
}

TEST(Node, AStreamThatStarvesIsHeld) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    std::vector<int32_t> move(2000);
    for (int k = 0; k < 2000; k++)
        move[size_t(k)] = 256 * 10 * k;
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    ASSERT_EQ(d.write(0x2A01, 3, 2000, 4), 0U);
    while (d.node.stream.filled < 600)
        d.give(SID_ID_REFERENCES + 5, reference_frame(move, d.node.stream.filled, 14));
    ASSERT_EQ(d.write(0x2A01, 4, 1, 4), 0U);
    d.run_out(800);
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_STREAM_STARVED));
    d.step(8000);
    EXPECT_LT(std::fabs(d.axis.speed_rad_s), 1e-3);
}

TEST(Node, HeartbeatsComeInTheirTimeAndBootUpFirst) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.step(8000);
    int beats = 0;
    ASSERT_FALSE(d.sent.empty());
    EXPECT_EQ(d.sent[0].data[0], 0) << "boot-up";
    for (const sid_can_frame_t& f : d.sent)
        beats += f.id == SID_ID_HEARTBEAT + 5 && f.data[0] == 5;
    EXPECT_EQ(beats, 20) << "a second, every 50 ms";
}

TEST(Node, ResetAndStopHoldTheAxis) {
    for (const uint8_t nmt : {uint8_t{0x02}, uint8_t{0x81}, uint8_t{0x82}}) {
        NodeDrive d;
        ASSERT_TRUE(d.begin());
        d.plan_one(50, 0.1, 1);
        d.step(300);
        d.give(0, {nmt, 6}); // another node
        EXPECT_GE(d.command.held, 0);
        d.give(0, {nmt, 5});
        d.step(1);
        EXPECT_LT(d.command.held, 0);
        EXPECT_EQ(sid_node_is_reset_requested(&d.node), nmt != 2);
    }
}

// A million bytes of nonsense: no undefined behaviour (the other build of this test), no motion,
// and the node still answers.
TEST(Node, NonsenseMovesNothing) {
    std::mt19937 random(seed_of("nonsense"));
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    for (int k = 0; k < 20000; k++) {
        const uint32_t id[] = {0x605, 0x505, 0x77F, 0x485, 0x605, 0x605};
        std::vector<uint8_t> data(random() % 3 == 0 ? random() % 65 : 8);
        for (uint8_t& b : data)
            b = uint8_t(random());
        if (data.size() == 8 && random() % 2) {
            const uint8_t first[] = {0x40, 0x2F, 0x2B, 0x23, 0x22, 0x27};
            data[0] = first[random() % 6], data[2] = 0x2A, data[1] = uint8_t(random() % 24);
            data[3] = uint8_t(random() % 13);
            if (data[1] == 1 && (data[3] == 1 || data[3] == 4)) data[3] = 9; // no claim, no start
        }
        d.give(id[random() % 6], data);
        if (k % 10 == 0) d.step(1, false);
        ASSERT_EQ(d.command.reference_q8, 0);
    }
    EXPECT_EQ(d.value_at(0x2A02, 1), uint32_t(SID_STATE_IDLE));
}
