#include "support.hpp"

#include <gtest/gtest.h>

namespace {

// Eq. (16) in long double, same sampling conventions, rounding nowhere.
struct DoubleLoop {
    long double kp, kv, ki, limit, sum = 0;
    int average;
    std::vector<int32_t> past = {0, 0, 0, 0};
    long double step(int32_t reference_q8, int32_t position) {
        const long double v = (long double)(position - past[size_t(average - 1)]) / average;
        past.insert(past.begin(), position);
        const long double e = kp * (reference_q8 / 256.0L - position) - v;
        const long double demand = kv * (e + sum + ki * e);
        const bool out = std::fabs(demand) > limit;
        if (!out || demand * e < 0) sum += ki * e;
        return std::fmax(-limit, std::fmin(limit, demand));
    }
};

struct Case {
    const char* name;
    double position_gain, speed_gain, integral_gain;
    int average, range;
};

TEST(Loop, IndistinguishableFromTheSameLoopInLongDouble) {
    const Case cases[] = {{"15 bit", 0.005, 7e-3, 7.8e-3, 1, 3000},
                          {"17 bit", 0.005, 1.75e-3, 7.8e-3, 1, 20000},
                          {"24 bit", 0.005, 1.37e-5, 7.8e-3, 2, 2700000},
                          {"linear 50 nm, 1 ms", 0.04, 2e-5, 0.05, 3, 5000000},
                          {"coarse", 0.005, 0.4, 0.01, 4, 40},
                          {"no integrator", 0.02, 3e-4, 0, 1, 100000}};
    std::mt19937 random(seed_of("loop"));
    for (const Case& c : cases) {
        sid_loop_config_t config{};
        config.position_gain = scaled(c.position_gain);
        config.speed_gain = scaled(c.speed_gain);
        config.integral_gain = scaled(c.integral_gain);
        config.torque_limit_pu_q20 = 1 << 20;
        config.speed_average = uint8_t(c.average);
        sid_loop_t loop;
        ASSERT_TRUE(sid_loop_init(&loop, &config)) << c.name;
        DoubleLoop exact{value(config.position_gain),
                         value(config.speed_gain),
                         value(config.integral_gain),
                         1,
                         0,
                         c.average};
        double worst = 0, position = 0, speed = 0;
        int clipped = 0;
        for (int k = 0; k < 50000; k++) {
            speed +=
                ((random() % 2001) / 1000.0 - 1) * c.range * 2e-4 - speed * 0.02 - position * 1e-4;
            position += speed;
            const int32_t p = int32_t(std::lround(position));
            const int32_t r = int32_t(c.range * 256 * 0.5 * std::sin(k * 0.01));
            const long double want = exact.step(r, p);
            const int32_t got = sid_loop_step(&loop, r, p);
            clipped += std::abs(got) == 1 << 20;
            worst = std::max(worst, double(std::fabs(got - want * 1048576)));
        }
        std::printf("  %s: worst %.2f LSB of Q20, %d samples at the limit\n", c.name, worst,
                    clipped);
        EXPECT_LE(worst, 1.0) << c.name;
    }
}

TEST(Loop, RestsWithoutDrift) {
    Axis axis = system_1();
    const sid_loop_config_t config = paper_loop(axis);
    sid_loop_t loop;
    ASSERT_TRUE(sid_loop_init(&loop, &config));
    for (int k = 0; k < 1000000; k++)
        ASSERT_EQ(sid_loop_step(&loop, 0, 0), 0) << "rounding, not truncation";
}

TEST(Loop, NothingOverflowsAtTheExtremes) {
    for (double kv : {1e-15, 1.0, 500.0}) {
        sid_loop_config_t config{};
        config.position_gain = scaled(1);
        config.speed_gain = scaled(kv);
        config.integral_gain = scaled(1);
        config.torque_limit_pu_q20 = (1 << 23) - 1;
        sid_loop_t loop;
        ASSERT_TRUE(sid_loop_init(&loop, &config));
        std::mt19937 random(seed_of("extremes"));
        for (int k = 0; k < 20000; k++) {
            const int32_t r = random() % 2 ? INT32_MAX : INT32_MIN,
                          p = random() % 2 ? INT32_MAX : INT32_MIN;
            const int32_t t = sid_loop_step(&loop, r, p);
            ASSERT_LE(std::abs(t), (1 << 23) - 1);
        }
        for (int k = 0; k < 2000; k++)
            sid_loop_step(&loop, INT32_MAX, 0);
        if (kv > 0.1) {
            EXPECT_EQ(sid_loop_step(&loop, INT32_MAX, 0), (1 << 23) - 1);
            EXPECT_GT(loop.saturated_samples, 0u);
        }
    }
}

TEST(Loop, LeavesTheLimitAtOnceAfterALongSaturation) {
    Axis axis = system_1();
    sid_loop_config_t config = paper_loop(axis);
    config.torque_limit_pu_q20 = 1 << 17;
    sid_loop_t loop;
    ASSERT_TRUE(sid_loop_init(&loop, &config));
    for (int k = 0; k < 80000; k++)
        sid_loop_step(&loop, 1 << 24, 0);
    EXPECT_EQ(loop.saturated_samples, 80000u);
    int back = 0;
    while (sid_loop_step(&loop, -(1 << 24), 0) > 0)
        back++;
    EXPECT_LE(back, 1);
}

TEST(Loop, RefusesGainsOutOfRange) {
    sid_loop_config_t config = paper_loop(system_1());
    sid_loop_t loop;
    config.torque_limit_pu_q20 = 0;
    EXPECT_FALSE(sid_loop_init(&loop, &config));
    config = paper_loop(system_1());
    config.position_gain = scaled(1.5);
    EXPECT_FALSE(sid_loop_init(&loop, &config));
    config = paper_loop(system_1());
    config.speed_gain = scaled(-1);
    EXPECT_FALSE(sid_loop_init(&loop, &config));
    config = paper_loop(system_1());
    config.integral_gain = scaled(-0.1);
    EXPECT_FALSE(sid_loop_init(&loop, &config));
    config = paper_loop(system_1());
    config.speed_average = 5;
    EXPECT_FALSE(sid_loop_init(&loop, &config));
}

} // namespace
