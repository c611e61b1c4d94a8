// Periods that are a whole number of samples, and not; drift; records that do not repeat.
#include "compare/period.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStep = 1e-3;

Capture record(int rows, const std::function<double(double)>& position) {
    Capture c;
    c.sample_time_s = kStep;
    for (int i = 0; i < rows; ++i)
        c.time_s.push_back(i * kStep), c.position.push_back(position(i * kStep));
    return c;
}

// Several harmonics: a period, not a sine.
double shape(double phase) {
    return std::sin(kTurn * phase) + 0.4 * std::cos(2 * kTurn * phase) +
           0.2 * std::sin(3 * kTurn * phase);
}

TEST(Period, WholeSamples) {
    const auto period = find_period(record(4000, [](double t) { return shape(t / 0.8); }));
    ASSERT_TRUE(period);
    EXPECT_NEAR(*period, 0.8, 1e-5);
}

TEST(Period, FractionOfASample) {
    for (const double truth : {0.4003, 0.40071, 0.5333333}) {
        const auto period = find_period(record(4000, [&](double t) { return shape(t / truth); }));
        ASSERT_TRUE(period) << truth;
        EXPECT_NEAR(*period, truth, 0.05 * kStep);
    }
}

TEST(Period, ReferenceIsLookedAtFirst) {
    Capture c = record(4000, [](double t) { return shape(t / 0.8); });
    for (double t : c.time_s)
        c.position_ref.push_back(shape(t / 0.5));
    EXPECT_NEAR(find_period(c).value_or(0), 0.5, 1e-5);
}

TEST(Period, StatedPeriodIsTaken) {
    Capture c = record(4000, [](double t) { return shape(t / 0.8); });
    c.period_s = 1.6;
    EXPECT_EQ(find_period(c), 1.6);
}

TEST(Period, StatedPeriodThatDoesNotFitTwiceIsNone) {
    Capture c = record(1000, [](double t) { return shape(t / 0.8); });
    c.period_s = 0.8;
    EXPECT_FALSE(find_period(c));
}

TEST(Period, NoiseOnThePosition) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.03);
    const auto period =
        find_period(record(6000, [&](double t) { return shape(t / 0.8) + noise(random); }));
    ASSERT_TRUE(period);
    EXPECT_NEAR(*period, 0.8, 2 * kStep);
}

// Slow drift of a few per cent of the move, as a warming axis has it.
TEST(Period, SlowDrift) {
    const auto period =
        find_period(record(6000, [](double t) { return shape(t / 0.8) + 0.01 * t; }));
    ASSERT_TRUE(period);
    EXPECT_NEAR(*period, 0.8, 2 * kStep);
}

TEST(Period, OneMoveDoesNotRepeat) {
    EXPECT_FALSE(find_period(record(4000, [](double t) { return std::tanh(5 * (t - 2)); })));
    EXPECT_FALSE(find_period(record(4000, [](double t) { return t; })));
    EXPECT_FALSE(find_period(record(4000, [](double t) { return std::sin(3 * t * t); })));
}

TEST(Period, LessThanTwoPeriodsAreNone) {
    EXPECT_FALSE(find_period(record(1500, [](double t) { return shape(t / 0.8); })));
}

TEST(Period, StandingStill) {
    EXPECT_FALSE(find_period(record(4000, [](double) { return 2.0; })));
}

TEST(Period, UnevenTimesHaveNone) {
    Capture c = record(4000, [](double t) { return shape(t / 0.8); });
    c.uniform = false;
    EXPECT_FALSE(find_period(c));
}

} // namespace
