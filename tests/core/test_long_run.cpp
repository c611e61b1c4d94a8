// A drive that stays on for a day: SERVOID_LONG_RUN_HOURS of samples at 8 kHz, 24 with --long, a
// quarter of one by default. What may wrap or drift is brought to it: phase, ticks, encoder.
#include "node_drive.hpp"

namespace {

constexpr int64_t kRate = 8000;
constexpr uint64_t kRate_uHz = 8000000000U;

int64_t samples_to_run() {
    const char* given = std::getenv("SERVOID_LONG_RUN_HOURS");
    return std::llround((given ? std::atof(given) : 0.25) * 3600 * double(kRate));
}

double hours(int64_t samples) { return double(samples) / double(kRate) / 3600; }

// Errors of J: over all, and their means over the first hour and the last (or eighth of the run).
struct Drift {
    int64_t total, part;
    double worst = 0, first = 0, last = 0;
    int64_t count = 0, firsts = 0, lasts = 0;
    explicit Drift(int64_t samples) : total(samples), part(std::min(3600 * kRate, samples / 8)) {}
    void take(int64_t sample, double error) {
        worst = std::fmax(worst, std::fabs(error));
        count++;
        if (sample < part) first += error, firsts++;
        if (sample >= total - part) last += error, lasts++;
    }
    double of_first() const { return first / double(firsts); }
    double of_last() const { return last / double(lasts); }
};

// A rigid axis with viscous friction under a torque that is held, exact at the samples; the way
// travelled is a whole number of counts and a rest, so that a day at full speed costs no precision.
struct ExactAxis {
    Axis data = system_1();
    double keep = std::exp(-data.viscous_Nms / data.inertia_kgm2 * data.sample_s);
    double speed_per_torque = (1 - keep) / data.viscous_Nms;
    double way_per_speed = speed_per_torque * data.inertia_kgm2;
    double way_per_torque = (data.sample_s - way_per_speed) / data.viscous_Nms;
    int64_t base_count = 0;
    double rest_rad = 0, speed = 0;

    void advance(double torque_Nm) {
        rest_rad += way_per_speed * speed + way_per_torque * torque_Nm;
        speed = keep * speed + speed_per_torque * torque_Nm;
    }
    int64_t count() const { return base_count + int64_t(std::floor(rest_rad / data.count_rad())); }
};

// Sessions one after the other, half a second each. Between them the drive does its work: the axis
// turns one way at 8600 rpm, 1.6e12 counts a day, the interrupt goes on. Every tenth session begins
// where the encoder's 32 bits roll over.
TEST(LongRun, SessionsOfADayGiveTheSameInertia) {
    const int64_t samples = samples_to_run();
    for (const uint8_t bits : {uint8_t(32), uint8_t(17)}) {
        ExactAxis axis;
        const uint32_t mask = bits == 32 ? ~0U : (1U << bits) - 1;
        sid_frequency_t plan = {increment_of(100),
                                int32_t(std::lround(256 / axis.data.count_rad()))};
        sid_result_t result{};
        sid_identify_config_t config{};
        config.plan = &plan, config.results = &result, config.plan_length = 1;
        config.windows = 4, config.position_bits = bits;
        config.torque_timing = SID_TORQUE_HELD_LAST;
        sid_identify_t session;
        ASSERT_TRUE(sid_identify_init(&session, &config));
        sid_loop_t loop;
        const sid_loop_config_t gains = paper_loop(axis.data);
        ASSERT_TRUE(sid_loop_init(&loop, &gains));
        std::mt19937_64 random(seed_of("sessions of a day"));
        std::uniform_real_distribution<double> within(0, 1); // of a count, where a session begins
        const int64_t cycle = 4000;
        const int64_t share = samples / cycle * cycle;
        Drift drift(share);
        int64_t travelled = 0;
        sid_command_t command{};
        for (int64_t start = 0, run = 0; start < share; start += cycle, run++) {
            if (run % 10 == 0) axis.base_count |= 0xFFFFFFFFLL;
            axis.rest_rad = within(random) * axis.data.count_rad(), axis.speed = 0;
            const int64_t zero = axis.count();
            int32_t torque = 0;
            sid_loop_reset(&loop, 0);
            ASSERT_TRUE(sid_identify_start(&session, uint32_t(zero) & mask));
            int64_t k = 0;
            for (; k < cycle && sid_identify_poll(&session, 64) < SID_STATE_DONE; k++) {
                const int64_t count = axis.count();
                const sid_sample_t in = {uint32_t(count) & mask, torque};
                sid_identify_step(&session, &in, &command);
                torque = sid_loop_step(&loop, command.reference_q8, int32_t(count - zero));
                axis.advance(torque / 1048576.0 * axis.data.rated_Nm);
            }
            ASSERT_EQ(sid_identify_reason(&session), SID_OK) << "run " << run;
            drift.take(start, axis.data.inertia_of(result.inertia) / axis.data.inertia_kgm2 - 1);
            for (; k < cycle; k++) {
                axis.base_count += 2345;
                const sid_sample_t in = {uint32_t(axis.count()) & mask, 30000};
                sid_identify_step(&session, &in, &command);
                travelled += 2345;
            }
        }
        EXPECT_EQ(session.counters.missed_polls, 0U);
        EXPECT_EQ(session.counters.torque_saturated_samples, 0U);
        EXPECT_LT(drift.worst, 2e-3);
        EXPECT_LT(std::fabs(drift.of_last() - drift.of_first()), 1e-5);
        std::printf(
            "figure: long run, encoder of %d bits: %.3f h, %lld sessions, %.3g counts one way: "
            "error of J at most %.1f ppm, mean %.2f ppm first, %.2f ppm last\n",
            bits, hours(share), (long long)drift.count, double(travelled), 1e6 * drift.worst,
            1e6 * drift.of_first(), 1e6 * drift.of_last());
    }
}

// One leg without an end: the reference against the exact sine of the frequency itself (not of its
// rounded increment), and J of windows all along it.
TEST(LongRun, OneExcitationOfADayKeepsItsPhase) {
    const int64_t samples = samples_to_run();
    const uint64_t frequency_uHz = 53123457;
    const uint64_t increment = sid_phase_increment(frequency_uHz, kRate_uHz);
    const double amplitude_q8 = 900000, position_scale = 4000, torque_scale = 100000, drag = 20000;
    const double omega = 2 * M_PI * double(frequency_uHz) / double(kRate_uHz);
    const double truth = torque_scale / 1048576 / position_scale / (omega * omega);
    sid_excite_t excite;
    const sid_excite_config_t guards = {32, 0, 1 << 20, 1 << 21, 1 << 22};
    const sid_leg_t leg = {increment, int32_t(amplitude_q8), 0, 1U << 30, 1 << 30};
    ASSERT_TRUE(sid_excite_init(&excite, &guards));
    sid_excite_rebase(&excite, 0);
    ASSERT_TRUE(sid_excite_begin(&excite, &leg));
    const uint32_t window = 1301;
    const sid_inertia_config_t config{};
    sid_bin_t bin{};
    Drift drift(samples);
    long double phase_error = 0, amplitude_error = 0;
    double reference_error = 0;
    uint64_t turn_uHz = 0; // exact phase times kRate_uHz
    uint32_t left = 0;
    for (int64_t k = 0; k < samples; k++) {
        const double angle = 2 * M_PI * double(turn_uHz) / double(kRate_uHz);
        const double sine = std::sin(angle), cosine = std::cos(angle);
        if (k % (4 * window) == 0) {
            ASSERT_TRUE(sid_bin_start(&bin, increment, increment * uint64_t(k), window));
            left = window;
        }
        const sid_sample_t in = {uint32_t(int32_t(std::lround(position_scale * sine))),
                                 int32_t(std::lround(-torque_scale * sine + drag * cosine))};
        sid_command_t out;
        sid_excite_step(&excite, &in, &out);
        ASSERT_EQ(out.held, 0);
        reference_error =
            std::fmax(reference_error, std::fabs(out.reference_q8 - amplitude_q8 * sine));
        if (left != 0) {
            sid_bin_step(&bin, in.torque_pu_q20, int32_t(in.position_raw));
            if (--left == 0) {
                sid_result_t result;
                (void)sid_bin_gram_advance(&bin, window);
                ASSERT_EQ(sid_inertia_solve(&bin, &config, &result), SID_OK);
                drift.take(k, value(result.inertia) / truth - 1);
            }
        }
        if (k % 1000 == 0 || k >= samples - 1000) {
            const sid_osc_t osc = sid_osc(increment * uint64_t(k));
            const long double exact = 2 * M_PIl * (long double)turn_uHz / kRate_uHz;
            const long double s = sinl(exact), c = cosl(exact);
            phase_error = std::fmax(phase_error, std::fabs(osc.sine_q31 * c - osc.cosine_q31 * s));
            amplitude_error = std::fmax(
                amplitude_error, std::fabs(hypotl(osc.sine_q31, osc.cosine_q31) - 2147483648.0L));
        }
        turn_uHz += frequency_uHz;
        turn_uHz -= turn_uHz >= kRate_uHz ? kRate_uHz : 0;
    }
    EXPECT_EQ(excite.tick, uint32_t(samples));
    EXPECT_LT(phase_error, 2.3L) << "2 LSB and what the increment's rounding adds up to";
    EXPECT_LT(amplitude_error, 2);
    EXPECT_LT(reference_error, 6) << "steps of 4 and the gain of 1 - 2^-30";
    EXPECT_LT(drift.worst, 1e-4);
    EXPECT_LT(std::fabs(drift.of_last() - drift.of_first()), 1e-6);
    std::printf(
        "figure: long run, one excitation: %.3f h, %lld samples: phase within %.2Lf LSB of Q31 of "
        "exact, amplitude within %.2Lf; reference within %.2f of Q8 of %.0f; %lld windows, error "
        "of "
        "J at most %.2f ppm, mean %.4f ppm first, %.4f ppm last\n",
        hours(samples), (long long)samples, phase_error, amplitude_error, reference_error,
        amplitude_q8, (long long)drift.count, 1e6 * drift.worst, 1e6 * drift.of_first(),
        1e6 * drift.of_last());
}

// The 31 bits of the tick: the leg ends by itself, the tick stops, nothing moves again.
TEST(LongRun, TheTickStopsAndDoesNotBeginAgain) {
    sid_excite_t excite;
    const sid_excite_config_t guards = {32, 0, 1 << 20, 1 << 21, 1 << 22};
    const sid_leg_t leg = {increment_of(50), 100000, 0, 1U << 30, 1 << 30};
    ASSERT_TRUE(sid_excite_init(&excite, &guards));
    sid_excite_rebase(&excite, 0);
    ASSERT_TRUE(sid_excite_begin(&excite, &leg));
    excite.tick = (1U << 30) - 100; // 37.3 h
    const sid_sample_t in = {0, 0};
    sid_command_t out;
    for (int k = 0; k < 200; k++)
        sid_excite_step(&excite, &in, &out);
    EXPECT_TRUE(sid_excite_is_still(&excite));
    EXPECT_EQ(out.reference_q8, 0);
    excite.tick = SID_TICK_PARKED - 100; // 74.6 h
    for (int k = 0; k < 1000; k++) {
        sid_excite_step(&excite, &in, &out);
        ASSERT_EQ(out.reference_q8, 0);
        ASSERT_EQ(out.held, 0);
    }
    EXPECT_EQ(excite.tick, SID_TICK_PARKED);
}

// A node whose tick rolls over in the middle of the run, and in the middle of a session: telemetry
// without a gap, heartbeats in time, and the master's heartbeat still watched.
TEST(LongRun, ANodeGoesOnWhereItsTickRollsOver) {
    const int64_t samples = samples_to_run();
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    const uint32_t before_wrap = uint32_t(samples / 2);
    d.node.telemetry.written = d.node.telemetry.read = 0U - before_wrap;
    d.node.heartbeat_due = d.node.telemetry.written;
    d.heartbeat();
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    ASSERT_EQ(d.write(0x2A01, 6, 1, 1), 0U); // telemetry on
    const int64_t session_every = std::min<int64_t>(800000, samples / 4);
    uint32_t expected = d.node.telemetry.written, run = 0;
    int64_t frames = 0, heartbeats = 0, sessions = 0;
    double worst = 0;
    const auto look = [&] {
        for (const sid_can_frame_t& frame : d.sent) {
            if (frame.id == SID_ID_HEARTBEAT + NodeDrive::kNode) heartbeats++;
            if (frame.id != SID_ID_TELEMETRY + NodeDrive::kNode ||
                frame.data[0] != SID_FRAME_SAMPLES)
                continue;
            ASSERT_EQ(sid_get_u32(&frame.data[4]), expected) << "frame " << frames;
            expected += SID_TELEMETRY_ROWS;
            frames++;
        }
        d.sent.clear();
    };
    const auto rest = [&] { // where NodeDrive's loop has its zero
        d.axis.angle_rad = 0.5 * d.axis.count_rad(), d.axis.speed_rad_s = 0, d.torque = 0;
        sid_loop_reset(&d.loop, 0);
    };
    rest();
    int64_t k = 0;
    const auto advance = [&](bool is_moving) {
        if (is_moving) {
            d.interrupt();
        } else {
            const sid_sample_t in = {d.axis.raw(), d.torque};
            sid_node_step(&d.node, &in, &d.command);
        }
        if (k % 80 == 0) d.heartbeat();
        if (k % 16 == 0) d.background(), look();
        k++;
    };
    while (k < samples) {
        // The second one is in the middle of its 1500 samples where the tick rolls over.
        if (k % session_every == session_every / 3 || k + 700 == int64_t(before_wrap)) {
            d.plan_one(100, 1, ++run);
            while (sid_node_is_running(&d.node) && k < samples + 40000)
                advance(true);
            ASSERT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_OK)) << "at sample " << k;
            worst = std::fmax(
                worst,
                std::fabs(d.axis.inertia_of(d.results[0].inertia) / d.axis.inertia_kgm2 - 1));
            sessions++;
            rest();
            continue;
        }
        advance(false);
        ASSERT_FALSE(::testing::Test::HasFatalFailure());
    }
    EXPECT_LT(d.node.telemetry.written, 1U << 31) << "it has rolled over";
    EXPECT_EQ(d.node.telemetry.lost, 0U);
    EXPECT_GE(sessions, 3);
    EXPECT_LT(worst, 0.015);
    EXPECT_NEAR(double(heartbeats), double(k) / 400, double(k) / 400 * 0.05);
    d.plan_one(20, 0.1, ++run);
    d.step(2000, false);
    EXPECT_EQ(d.value_at(0x2A02, 2), uint32_t(SID_MASTER_LOST));
    std::printf(
        "figure: long run, node: %.3f h across its tick's 2^32: %lld frames without a gap, %lld "
        "heartbeats, %lld sessions, error of J at most %.2f %%\n",
        hours(k), (long long)frames, (long long)heartbeats, (long long)sessions, 100 * worst);
}

} // namespace
