// A torque that the model lacks for a moment: the part of the record that holds it is named.
#include "compare/compare.hpp"
#include "compare/over_time.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

using namespace servoid;

namespace {

constexpr double kInertia = 0.01;

Capture with_pulse(double from, double to) {
    return sampled(
        [=](const Kinematics& k, double t) {
            return kInertia * k.acceleration + (t > from && t < to ? 0.1 : 0);
        },
        12);
}

Model model() {
    Model out;
    out.inertia = kInertia;
    return out;
}

std::vector<TimePart> parts_of(const std::vector<Capture>& captures, int count) {
    MotionOptions options;
    options.band_Hz = 40;
    return residual_over_time(model(), {}, prepare_all(std::span(captures), options), count);
}

TEST(OverTime, ThePulseIsTheWorstPlace) {
    const std::vector<Capture> captures = {with_pulse(7.1, 7.3)};
    const std::vector<TimePart> parts = parts_of(captures, 24);
    ASSERT_EQ(parts.size(), 24U);
    const std::vector<size_t> worst = worst_of(parts, 3);
    ASSERT_EQ(worst.size(), 1U);
    EXPECT_LT(parts[worst[0]].from_s, 7.2);
    EXPECT_GT(parts[worst[0]].to_s, 7.2);
    EXPECT_FALSE(parts[worst[0]].regime.empty());
    EXPECT_NEAR(rms_of(parts), 0.1 * std::sqrt(0.2 / 12), 0.1 * 0.1 * std::sqrt(0.2 / 12));
}

TEST(OverTime, SeveralCapturesOneAfterTheOther) {
    const std::vector<Capture> captures = {with_pulse(0, 0), with_pulse(3.1, 3.4)};
    const std::vector<TimePart> parts = parts_of(captures, 30);
    ASSERT_EQ(parts.size(), 30U);
    EXPECT_EQ(parts[14].capture, 0U);
    EXPECT_EQ(parts[15].capture, 1U);
    EXPECT_EQ(parts[worst_of(parts, 1).at(0)].capture, 1U);
}

TEST(OverTime, WorstFirstAndOnlyPeaks) {
    const std::vector<double> values = {1, 4, 5, 4, 1, NAN, 9, 1, 1, 1};
    std::vector<TimePart> parts;
    for (const double rms : values) {
        parts.emplace_back();
        parts.back().rms = rms;
    }
    EXPECT_EQ(worst_of(parts, 5), (std::vector<size_t>{6, 2}));
    EXPECT_EQ(worst_of(parts, 1), (std::vector<size_t>{6}));
    EXPECT_TRUE(worst_of({}, 3).empty());
}

} // namespace
