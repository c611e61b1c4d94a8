#include "support.hpp"

#include <gtest/gtest.h>

namespace {

sid_excite_config_t guards(int bits = 32, int shift = 0) {
    sid_excite_config_t c{};
    c.position_bits = uint8_t(bits);
    c.position_shift = uint8_t(shift);
    c.step_limit = 5000;
    c.stroke_limit = 100000;
    c.torque_limit = 1 << 20;
    return c;
}
sid_leg_t leg(double f = 100, double amplitude = 1000, uint32_t ramp = 0, uint32_t length = 4000) {
    return {increment_of(f), int32_t(amplitude * 256), ramp, length, 1 << 30};
}

struct Rig {
    sid_excite_t excite{};
    uint32_t raw;
    int32_t torque = 100;
    explicit Rig(sid_excite_config_t c = guards(), sid_leg_t l = leg(), uint32_t start = 0xFFFFFF00)
        : raw(start) {
        EXPECT_TRUE(sid_excite_init(&excite, &c));
        sid_excite_rebase(&excite, raw);
        EXPECT_TRUE(sid_excite_begin(&excite, &l));
    }
    sid_command_t step(int32_t moved = 1) {
        raw += uint32_t(moved);
        const sid_sample_t in = {raw, torque};
        sid_command_t out;
        sid_excite_step(&excite, &in, &out);
        return out;
    }
};

TEST(Excite, IsASineFromRest) {
    Rig rig;
    double worst = 0;
    for (int k = 0; k < 3000; k++) {
        const double exact = 1000 * std::sin(2 * M_PI * 100 * k / 8000.0);
        worst = std::max(worst, std::fabs(rig.step(k % 2 ? 1 : -1).reference_q8 / 256.0 - exact));
    }
    std::printf("  worst error of the reference %.4f counts\n", worst);
    EXPECT_LE(worst, 1 / 64.0 + 1 / 128.0);
}

TEST(Excite, RampsAreContinuousAndEndAtRest) {
    for (uint32_t ramp : {1u, 2u, 80u, 333u, 5000u}) {
        Rig rig(guards(), leg(100, 1000, ramp, ramp + 4000));
        double peak_up = 0, before = 0, step = 0, peak = 0;
        for (uint32_t k = 0; k < ramp + 4000; k++) {
            const double r = rig.step(k % 2 ? 1 : -1).reference_q8 / 256.0;
            EXPECT_LE(std::fabs(r), 1000.1 * std::min(1.0, (k + 2.0) / ramp)) << ramp << " " << k;
            if (k < ramp / 2) peak_up = std::max(peak_up, std::fabs(r));
            peak = std::max(peak, std::fabs(r));
            step = std::max(step, std::fabs(r - before));
            before = r;
        }
        EXPECT_FALSE(sid_excite_is_still(&rig.excite));
        EXPECT_NEAR(peak, 1000, 0.1);
        EXPECT_LE(peak_up, 501 + 1000.0 / ramp);
        for (uint32_t k = 0; k < ramp + 3; k++) {
            const double r = rig.step(k % 2 ? 1 : -1).reference_q8 / 256.0;
            if (ramp > 100) step = std::max(step, std::fabs(r - before));
            before = r;
        }
        EXPECT_LE(step, 1000 * 2 * M_PI * 100 / 8000 + 1000.0 / ramp + 0.1);
        EXPECT_TRUE(sid_excite_is_still(&rig.excite));
        for (int k = 0; k < 1000; k++)
            EXPECT_EQ(rig.step(0).reference_q8, 0);
        sid_excite_park(&rig.excite);
        EXPECT_EQ(rig.step(0).reference_q8, 0);
    }
}

TEST(Excite, ADeadBackgroundCannotStartTheMotionAgain) {
    Rig rig;
    rig.excite.tick = SID_TICK_PARKED - 10;
    for (int k = 0; k < 100; k++) {
        EXPECT_EQ(rig.step(k % 2).reference_q8, 0);
        EXPECT_LE(rig.excite.tick, SID_TICK_PARKED);
    }
}

struct Trip {
    const char* name;
    sid_trip_t trip;
    int32_t moved, torque;
};

TEST(Excite, EveryGuardHoldsTheAxisWithinTheSameSample) {
    const Trip cases[] = {{"stroke", SID_TRIP_STROKE, 4000, 100},
                          {"negative stroke", SID_TRIP_STROKE, -4000, 100},
                          {"torque", SID_TRIP_TORQUE, 3, (1 << 20) + 1},
                          {"negative torque", SID_TRIP_TORQUE, 3, -(1 << 20) - 2},
                          {"worst torque", SID_TRIP_TORQUE, 3, INT32_MIN},
                          {"jump", SID_TRIP_JUMP, 5001, 100},
                          {"negative jump", SID_TRIP_JUMP, -5001, 100},
                          {"worst jump", SID_TRIP_JUMP, INT32_MIN, 100}};
    for (const Trip& c : cases) {
        Rig rig;
        int32_t position = 0;
        for (int k = 0; k < 500; k++) {
            const int32_t m = k % 3 - 1;
            position += m;
            ASSERT_GE(rig.step(m).held, 0) << c.name;
        }
        while (c.trip == SID_TRIP_STROKE && position + c.moved <= 100000 &&
               position + c.moved >= -100001) {
            position += c.moved;
            ASSERT_GE(rig.step(c.moved).held, 0);
        }
        rig.torque = c.torque;
        const sid_command_t out = rig.step(c.moved);
        if (c.trip != SID_TRIP_JUMP) position += c.moved;
        EXPECT_LT(out.held, 0) << c.name;
        EXPECT_EQ(out.reference_q8, position * 256) << c.name << ": the measured position, at once";
        EXPECT_EQ(sid_excite_trip(&rig.excite), c.trip) << c.name;
        std::mt19937 random(seed_of(c.name));
        for (int k = 0; k < 1000; k++) {
            rig.torque = int32_t(random());
            ASSERT_EQ(rig.step(int32_t(random())).reference_q8, position * 256)
                << "and stays there";
            ASSERT_EQ(sid_excite_trip(&rig.excite), c.trip) << c.name << ": the first reason stays";
        }
    }
}

TEST(Excite, StuckEncoderTripsOnImpulseWithoutMotion) {
    sid_leg_t l = leg();
    l.stuck_limit = 100000;
    Rig rig(guards(), l);
    rig.torque = 1000;
    for (int k = 0; k < 99; k++)
        ASSERT_GE(rig.step(0).held, 0);
    ASSERT_GE(rig.step(-1).held, 0) << "a single count of motion starts again";
    for (int k = 0; k < 99; k++)
        ASSERT_GE(rig.step(0).held, 0);
    EXPECT_LT(rig.step(0).held, 0);
    EXPECT_EQ(sid_excite_trip(&rig.excite), SID_TRIP_STUCK);
    EXPECT_EQ(rig.step(7).reference_q8, -256);
}

TEST(Excite, AbortHoldsAtTheNextSample) {
    Rig rig;
    for (int k = 0; k < 100; k++)
        rig.step(1);
    rig.torque = 0;
    sid_excite_abort(&rig.excite);
    const sid_command_t out = rig.step(1);
    EXPECT_LT(out.held, 0);
    EXPECT_EQ(out.reference_q8, 101 * 256);
}

TEST(Excite, PositionRollsOverAtEveryWidth) {
    std::mt19937 random(seed_of("roll-over"));
    for (int bits = 3; bits <= 32; bits++)
        for (int shift : {0, 1, 8}) {
            if (bits - shift < 3) continue;
            sid_excite_config_t c = guards(bits, shift);
            c.step_limit = std::min(5000, (1 << std::min(bits - 1, 20)) - 1);
            c.stroke_limit = (1 << 23) - 1 - (c.step_limit >> shift);
            const uint32_t mask = uint32_t((1ULL << bits) - 1), start = random() & mask;
            Rig rig(c, leg(), start);
            int64_t position = 0;
            for (int k = 0; k < 3000; k++) {
                const int32_t m = int32_t(random() % uint32_t(2 * c.step_limit + 1)) -
                                  c.step_limit + (k < 1500 ? c.step_limit / 2 : -c.step_limit / 2);
                const int32_t bounded = std::max(-c.step_limit, std::min(c.step_limit, m));
                position += bounded;
                const sid_sample_t in = {uint32_t(start + uint32_t(position)) & mask, 100};
                sid_tick_t now;
                sid_excite_guard(&rig.excite, &in, &now);
                ASSERT_EQ(now.position, (position + (1 << shift >> 1)) >> shift)
                    << bits << " bits, shift " << shift;
                ASSERT_GE(now.trip, 0);
            }
        }
}

TEST(Excite, RebaseClearsATripAndTakesANewZero) {
    Rig rig;
    rig.step(100000);
    rig.step(50000);
    EXPECT_NE(sid_excite_trip(&rig.excite), SID_TRIP_NONE);
    sid_excite_rebase(&rig.excite, rig.raw);
    EXPECT_EQ(sid_excite_trip(&rig.excite), SID_TRIP_NONE);
    sid_excite_park(&rig.excite);
    EXPECT_EQ(rig.step(5).reference_q8, 0);
    EXPECT_GE(rig.step(5).held, 0);
}

TEST(Excite, HeldPositionAlwaysFitsQ8) {
    sid_excite_config_t c = guards();
    c.step_limit = 1 << 22;
    c.stroke_limit = (1 << 23) - 1 - c.step_limit;
    for (int sign : {-1, 1}) {
        Rig rig(c);
        sid_command_t out{};
        while (out.held >= 0)
            out = rig.step(sign * (c.step_limit - 1));
        EXPECT_EQ(out.reference_q8 > 0, sign > 0);
        EXPECT_GT(std::llabs(int64_t(out.reference_q8)), int64_t(c.stroke_limit) * 256);
    }
}

TEST(Excite, RefusesWhatIsOutOfRange) {
    sid_excite_t e;
    for (int bits : {0, 33}) {
        const sid_excite_config_t c = guards(bits);
        EXPECT_FALSE(sid_excite_init(&e, &c));
    }
    sid_excite_config_t c = guards(32, 9);
    EXPECT_FALSE(sid_excite_init(&e, &c));
    c = guards();
    c.stroke_limit = (1 << 23) - c.step_limit;
    EXPECT_FALSE(sid_excite_init(&e, &c));
    c = guards();
    c.torque_limit = 1 << 23;
    EXPECT_FALSE(sid_excite_init(&e, &c));
    c = guards();
    ASSERT_TRUE(sid_excite_init(&e, &c));
    sid_leg_t l = leg();
    l.amplitude_q8 = 1 << 30;
    EXPECT_FALSE(sid_excite_begin(&e, &l));
    l = leg();
    l.increment_q64 = 1ULL << 63;
    EXPECT_FALSE(sid_excite_begin(&e, &l));
    l = leg();
    l.leg_ticks = 0;
    EXPECT_FALSE(sid_excite_begin(&e, &l));
}

} // namespace
