#include "support.hpp"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>

namespace {

// A drive around the core: position sampled, session stepped, loop run, torque held; poll after
// every sample.
struct Drive {
    Axis axis = system_1();
    sid_loop_t loop{};
    sid_identify_t session{};
    sid_identify_config_t config{};
    std::vector<sid_frequency_t> plan;
    std::vector<sid_result_t> results;
    int32_t torque = 0;
    sid_command_t command{};
    long step_count = 0;
    uint32_t poll_samples = 64;
    int poll_every = 1;
    std::function<void(sid_sample_t&)> fault = [](sid_sample_t&) {};

    explicit Drive(std::vector<double> frequencies = {100}, double amplitude_rad = 1) {
        for (double f : frequencies)
            plan.push_back(
                {increment_of(f), int32_t(std::lround(amplitude_rad / axis.count_rad() * 256))});
        results.resize(plan.size());
        std::memset(static_cast<void*>(results.data()), 0xA5, results.size() * sizeof(results[0]));
        config.position_bits = 17;
        config.torque_timing = SID_TORQUE_HELD_LAST;
    }
    bool begin() {
        config.plan = plan.data();
        config.plan_length = uint8_t(plan.size());
        config.results = results.data();
        const sid_loop_config_t c = paper_loop(axis);
        EXPECT_TRUE(sid_loop_init(&loop, &c));
        sid_loop_reset(&loop, int32_t(axis.count()));
        return sid_identify_init(&session, &config) && sid_identify_start(&session, axis.raw());
    }
    void sample() {
        sid_sample_t in = {axis.raw(), torque};
        fault(in);
        sid_identify_step(&session, &in, &command);
        torque = sid_loop_step(&loop, command.reference_q8, int32_t(axis.count()));
        axis.advance(torque / 1048576.0 * axis.rated_Nm);
        step_count++;
    }
    sid_state_t poll() { return sid_identify_poll(&session, poll_samples); }
    sid_state_t run(long most = 400000) {
        sid_state_t state = SID_STATE_MEASURING;
        for (long k = 0; k < most && state < SID_STATE_DONE; k++) {
            sample();
            if (k % poll_every == 0) state = poll();
        }
        return state;
    }
    double error_percent(size_t i = 0) const {
        return 100 * (axis.inertia_of(results[i].inertia) / axis.inertia_kgm2 - 1);
    }
};

TEST(Identify, ResultsStartAsNotRun) {
    Drive d({50, 100});
    d.config.plan = d.plan.data();
    d.config.plan_length = 2;
    d.config.results = d.results.data();
    ASSERT_TRUE(sid_identify_init(&d.session, &d.config));
    for (const sid_result_t& r : d.results) {
        EXPECT_EQ(r.reason, SID_NOT_RUN);
        EXPECT_EQ(r.inertia.mantissa, 0);
    }
    EXPECT_EQ(sid_identify_reason(&d.session), SID_NOT_RUN);
}

TEST(Identify, FindsTheInertiaOfSystem1AtEveryFrequencyOfThePaper) {
    std::vector<double> f;
    for (int i = 1; i <= 20; i++)
        f.push_back(10 * i);
    Drive d(f);
    d.config.rest_samples = 2000;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(sid_identify_reason(&d.session), SID_OK);
    double worst = 0;
    for (size_t i = 0; i < f.size(); i++) {
        ASSERT_EQ(d.results[i].reason, SID_OK) << f[i];
        worst = std::max(worst, std::fabs(d.error_percent(i)));
        EXPECT_NEAR(d.error_percent(i), 0, 1.5) << f[i] << " Hz";
    }
    std::printf(
        "  worst error of J %.2f %%, torque at 200 Hz %.2f %% of rated, amplitude %.4f rad\n",
        worst, 100 * value(d.results[19].torque_amplitude),
        value(d.results[19].position_amplitude) * d.axis.count_rad());
    EXPECT_EQ(d.command.reference_q8, 0);
    for (const uint32_t* c = &d.session.counters.torque_saturated_samples;
         c <= &d.session.counters.missed_polls; c++)
        EXPECT_EQ(*c, 0u);
}

TEST(Identify, RampSettleWindowsAndRampDownAreWhereTheyShouldBe) {
    Drive d({100});
    d.config.ramp_periods_q8 = 512;
    d.config.settle_periods_q8 = 256;
    d.config.windows = 3;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.session.window_start, 240u);
    EXPECT_EQ(d.session.bin.count, 160u);
    EXPECT_EQ(d.session.excite.leg_ticks, 240u + 2 * 240 + 160);
    ASSERT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].windows, 3);
    EXPECT_TRUE(d.results[0].std_known);
    EXPECT_GT(value(d.results[0].inertia_std), 0);
    EXPECT_NEAR(d.error_percent(), 0, 1.5);
}

TEST(Identify, LatePollsLoseWindowsAndAreCounted) {
    Drive d({100});
    d.config.windows = 8;
    d.poll_every = 700;
    d.poll_samples = 100000;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_OK);
    EXPECT_GT(d.session.counters.missed_polls, 0u);
    EXPECT_EQ(d.session.counters.missed_polls + d.results[0].windows, 8u);
    EXPECT_NEAR(d.error_percent(), 0, 1.5);
}

TEST(Identify, WithoutPollTheMotionEndsByItself) {
    Drive d({100});
    d.config.ramp_periods_q8 = 256;
    ASSERT_TRUE(d.begin());
    for (int k = 0; k < 5000; k++)
        d.sample();
    EXPECT_EQ(d.command.reference_q8, 0);
    EXPECT_EQ(d.poll(), SID_STATE_MEASURING);
    while (d.poll() < SID_STATE_DONE)
        d.sample();
    EXPECT_EQ(d.results[0].reason, SID_OK) << "and the sums were kept";
}

void expect_held(Drive& d) {
    const int32_t held = d.command.reference_q8;
    EXPECT_LT(d.command.held, 0);
    for (int k = 0; k < 100; k++) {
        d.sample();
        ASSERT_EQ(d.command.reference_q8, held);
    }
}

TEST(Identify, StrokeGuard) {
    Drive d({10});
    d.config.stroke_limit_count = 5000;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_ABORTED_STROKE);
    EXPECT_EQ(sid_identify_reason(&d.session), SID_ABORTED_STROKE);
    EXPECT_EQ(d.session.counters.stroke_aborts, 1u);
    expect_held(d);
}

TEST(Identify, TorqueGuard) {
    Drive d({100});
    d.config.torque_limit_pu_q20 = 1 << 17;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_ABORTED_TORQUE);
    EXPECT_EQ(d.session.counters.torque_aborts, 1u);
    expect_held(d);
}

TEST(Identify, AbortByUserAndStartAgain) {
    Drive d({100, 50});
    ASSERT_TRUE(d.begin());
    for (int k = 0; k < 300; k++)
        d.sample(), d.poll();
    EXPECT_FALSE(sid_identify_start(&d.session, 0)) << "one session at a time";
    sid_identify_abort(&d.session);
    d.sample();
    EXPECT_EQ(d.poll(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_ABORTED_BY_USER);
    EXPECT_EQ(d.results[1].reason, SID_NOT_RUN);
    EXPECT_EQ(d.session.counters.user_aborts, 1u);
    expect_held(d);
    sid_loop_reset(&d.loop, int32_t(d.axis.count()));
    d.axis = system_1();
    ASSERT_TRUE(sid_identify_start(&d.session, d.axis.raw()));
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_OK);
}

TEST(Identify, StuckEncoder) {
    Drive d({100});
    d.fault = [&](sid_sample_t& s) {
        static uint32_t frozen;
        if (d.step_count <= 200) frozen = s.position_raw;
        if (d.step_count > 200) s = {frozen, 300000};
    };
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_ENCODER_STUCK);
    EXPECT_EQ(d.session.counters.encoder_stuck, 1u);
    expect_held(d);
}

TEST(Identify, EncoderJump) {
    Drive d({100});
    d.fault = [&](sid_sample_t& s) { s.position_raw += d.step_count == 300 ? 40000 : 0; };
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_ENCODER_JUMP);
    EXPECT_EQ(d.session.counters.encoder_jumps, 1u);
    expect_held(d);
}

TEST(Identify, PersistentSaturationEndsTheSession) {
    Drive d({100, 50});
    d.config.torque_saturation_pu_q20 = 20000;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_ABORTED);
    EXPECT_EQ(d.results[0].reason, SID_SATURATED);
    EXPECT_EQ(d.results[1].reason, SID_NOT_RUN);
    EXPECT_GT(d.session.counters.torque_saturated_samples, 40u);
    EXPECT_EQ(d.command.reference_q8, 0) << "at rest";
}

TEST(Identify, ShortSaturationCostsOneFrequencyOnly) {
    Drive d({100, 50});
    d.config.torque_saturation_pu_q20 = 1 << 20;
    d.fault = [&](sid_sample_t& s) {
        s.torque_pu_q20 = d.step_count == 700 ? -(1 << 20) - 5 : s.torque_pu_q20;
    };
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_SATURATED);
    EXPECT_EQ(d.results[1].reason, SID_OK);
    EXPECT_EQ(sid_identify_reason(&d.session), SID_SATURATED);
    EXPECT_EQ(d.session.counters.torque_saturated_samples, 1u);
}

TEST(Identify, NoExcitation) {
    Drive d({100}, 0);
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_NO_EXCITATION);
    EXPECT_EQ(d.results[0].inertia.mantissa, 0);
}

// The encoder freezes for the last quarter of the window; the loop goes on with what it sees.
TEST(Identify, AnEncoderThatFreezesInTheWindowGivesNoInertia) {
    for (const bool trusting : {false, true}) {
        Drive d({50}, 1);
        uint32_t frozen = 0;
        d.fault = [&](sid_sample_t& in) {
            if (d.step_count < 1280 + 240)
                frozen = in.position_raw;
            else
                in.position_raw = frozen;
        };
        if (trusting) d.config.distortion_q8 = 255;
        ASSERT_TRUE(d.begin());
        d.run(1280 + 320);
        d.run();
        if (trusting) {
            EXPECT_EQ(d.results[0].reason, SID_OK);
            EXPECT_GT(std::fabs(d.error_percent()), 10) << "what is refused otherwise";
        } else {
            EXPECT_EQ(d.results[0].reason, SID_NOT_A_SINE);
            EXPECT_EQ(d.results[0].inertia.mantissa, 0);
        }
    }
}

// 40 interrupts that never came, at a turn, where the jump guard sees nothing.
TEST(Identify, MissingSamplesGiveNoInertia) {
    Drive d({50}, 1);
    ASSERT_TRUE(d.begin());
    for (int k = 0; k < 40000 && d.poll() < SID_STATE_DONE; k++) {
        if (d.step_count == 1400)
            for (int i = 0; i < 40; i++)
                d.axis.advance(d.torque / 1048576.0 * d.axis.rated_Nm);
        d.sample();
    }
    EXPECT_EQ(d.results[0].reason, SID_NOT_A_SINE);
}

// Friction takes nearly all of the torque: the axis stands for most of each period.
TEST(Identify, AnAxisThatSticksGivesNoInertia) {
    Drive d({20}, 0.2);
    d.axis.coulomb_Nm *= 3;
    ASSERT_TRUE(d.begin());
    d.run();
    EXPECT_EQ(d.results[0].reason, SID_NOT_A_SINE);
}

TEST(Identify, NegativeInertiaIsNeverAnAnswer) {
    Drive d({100});
    d.fault = [](sid_sample_t& s) { s.torque_pu_q20 = -s.torque_pu_q20; };
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_NEGATIVE_INERTIA);
}

TEST(Identify, WindowBelowOnePeriodIsTooShort) {
    Drive d({100});
    d.config.window_periods_q8 = 200;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_EQ(d.results[0].reason, SID_WINDOW_TOO_SHORT);
}

TEST(Identify, CubicTrendInOnePeriodMayBeIllConditioned) {
    Drive d({2600});
    d.config.window_periods_q8 = 256 * 3; // 9 samples
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.run(), SID_STATE_DONE);
    EXPECT_NE(d.results[0].reason, SID_OK);
}

TEST(Identify, RefusesAConfigurationOutOfRange) {
    const std::function<void(Drive&)> bad[] = {
        [](Drive& d) { d.plan[0].increment_q64 = 0; },
        [](Drive& d) { d.plan[0].increment_q64 = 1ULL << 63; },
        [](Drive& d) { d.plan[0].amplitude_q8 = -1; },
        [](Drive& d) { d.plan[0].amplitude_q8 = 1 << 30; },
        [](Drive& d) { d.plan[0].increment_q64 = increment_of(0.2); },
        [](Drive& d) { d.plan[0].increment_q64 = increment_of(2500); },
        [](Drive& d) { d.plan.clear(); },
        [](Drive& d) { d.config.windows = 9; },
        [](Drive& d) { d.config.position_bits = 33; },
        [](Drive& d) { d.config.position_shift = 9; },
        [](Drive& d) { d.config.stroke_limit_count = -1; },
        [](Drive& d) { d.config.torque_limit_pu_q20 = 1 << 23; },
        [](Drive& d) { d.config.torque_saturation_pu_q20 = -5; },
        [](Drive& d) { d.config.stuck_limit_pu_q20 = 0x80000000; },
        [](Drive& d) { d.config.rest_samples = 0xFFFFFFFF; }};
    for (const auto& spoil : bad) {
        Drive d;
        spoil(d);
        EXPECT_FALSE(d.begin()) << &spoil - bad;
    }
}

TEST(Identify, TorqueNoiseMovesJByItsStatedDeviation) {
    const unsigned kRuns = 300;
    double square = 0, stated = 0, mean = 0;
    const unsigned seed = seed_of("noise");
    std::vector<double> j;
    for (unsigned run = 0; run < kRuns; run++) {
        std::mt19937 random(seed + run);
        std::normal_distribution<double> noise(0, 20000);
        Drive d({100});
        d.config.windows = 8;
        d.fault = [&](sid_sample_t& s) { s.torque_pu_q20 += int32_t(noise(random)); };
        ASSERT_TRUE(d.begin());
        ASSERT_EQ(d.run(), SID_STATE_DONE);
        ASSERT_EQ(d.results[0].windows, 8);
        j.push_back(value(d.results[0].inertia));
        stated += std::pow(value(d.results[0].inertia_std), 2) / kRuns;
    }
    for (double x : j)
        mean += x / kRuns;
    for (double x : j)
        square += (x - mean) * (x - mean) / (kRuns - 1);
    std::printf("  stated / observed deviation: %.2f\n", std::sqrt(stated / square));
    EXPECT_NEAR(std::sqrt(stated / square), 1, 0.2);
}

TEST(Identify, ASampleOfATripCannotOverflowTheSums) {
    sid_bin_t bin;
    ASSERT_TRUE(sid_bin_start(&bin, increment_of(0.25), 0, 65535));
    for (uint32_t i = 0; i < 65534; i++)
        sid_bin_step(&bin, 8388607, 8388607);
    const sid_bin_row_t row = sid_bin_row(sid_osc(0), sid_bin_tau(&bin, 65534));
    __int128 exact[SID_BIN_SUMS];
    for (int k = 0; k < SID_BIN_SUMS; k++)
        exact[k] = bin.sums[k];
    sid_bin_accumulate(&bin, row, INT32_MIN, -8388608);
    exact[12] += __int128(INT32_MIN) * INT32_MIN;
    exact[14] += __int128(INT32_MIN) * -8388608;
    EXPECT_TRUE(exact[12] == bin.sums[12]);
    EXPECT_TRUE(exact[14] == bin.sums[14]);
}

TEST(Identify, AnySequenceOfSamplesLeavesTheInterruptAlive) {
    std::mt19937 random(seed_of("garbage"));
    for (int run = 0; run < 200; run++) {
        Drive d({200, 1000});
        d.config.windows = uint8_t(random() % 9);
        d.fault = [&](sid_sample_t& s) {
            if (random() % 50 == 0) s = {uint32_t(random()), int32_t(uint32_t(random()))};
        };
        ASSERT_TRUE(d.begin());
        const sid_state_t state = d.run(20000);
        ASSERT_GE(state, SID_STATE_DONE);
        ASSERT_NE(sid_identify_reason(&d.session), SID_NOT_RUN);
    }
}

} // namespace
