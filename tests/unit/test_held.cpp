// Where friction holds the axis: found, and taken out of torque and model alike.
#include "compare/compare.hpp"
#include "compare/held.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace servoid;

namespace {

constexpr double kStep_s = 1e-4;
constexpr double kCount = 5e-5;

Eigen::VectorXd counted(Eigen::VectorXd x) {
    for (double& value : x)
        value = std::round(value / kCount) * kCount;
    return x;
}

// A sine of 1 Hz that stands for `stop_s` at each of its turning points.
Eigen::VectorXd sine_with_stops(double stop_s, double amplitude) {
    Eigen::VectorXd x(30000);
    const double half = 0.5 + stop_s;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double t = double(i) * kStep_s, phase = std::fmod(t, half);
        const double sign = int(t / half) % 2 ? -1 : 1;
        const double moved = std::min(phase, 0.5);
        x[i] = -sign * amplitude * std::cos(2 * std::numbers::pi * moved);
    }
    return counted(x);
}

std::vector<Interval> found(const Eigen::VectorXd& x) {
    return held_intervals(x, kStep_s, 2.5 * kCount, 1e-4);
}

Model with_friction(double coulomb, const std::string& more) {
    return parse_model("motion = \"rotary\"\n[plant]\ninertia = 5.56e-5\n"
                       "[controller]\ntype = \"p_pi\"\nposition_gain = 40.0\nspeed_gain = 7e-3\n"
                       "integral_time = 0.016\nsample_time = 125e-6\n[sensor]\n"
                       "counts_per_rev = 131072\n[drive]\nrated_torque = 0.637\n"
                       "[effects.viscous]\ncoefficient = 1e-4\n[effects.coulomb]\ntorque = " +
                           std::to_string(coulomb) + "\n" + more,
                       "motor");
}

} // namespace

TEST(Held, FindsStopsOfEveryLength) {
    for (const double stop_s : {0.01, 0.03, 0.1}) {
        const auto all = found(sine_with_stops(stop_s, 0.5));
        ASSERT_GE(all.size(), 4u) << stop_s;
        for (const Interval& i : all) { // the way of two counts on both sides takes 5 ms
            EXPECT_GT(i.to_s - i.from_s, 0.9 * stop_s);
            EXPECT_LT(i.to_s - i.from_s, stop_s + 0.012);
        }
    }
}

// The way of two and a half counts at a turning point: 2·sqrt(2·way/acceleration).
TEST(Held, ATurningPointIsHeldForItsPassageAtMost) {
    for (const double amplitude : {0.5, 0.02}) {
        const double top = amplitude * std::pow(2 * std::numbers::pi, 2);
        for (const Interval& i : found(sine_with_stops(0, amplitude)))
            EXPECT_LT(i.to_s - i.from_s, 2 * std::sqrt(2 * 3 * kCount / top));
    }
}

TEST(Held, ASlowMotionIsNoStop) {
    Eigen::VectorXd ramp(20000), ripple(20000);
    for (Eigen::Index i = 0; i < ramp.size(); ++i) {
        const double t = double(i) * kStep_s;
        ramp[i] = 2e-3 * t;
        ripple[i] = 0.05 * t + 0.6 * 0.05 / 30 * std::sin(30 * t); // 0.4 to 1.6 of the speed
    }
    EXPECT_TRUE(found(counted(ramp)).empty());
    EXPECT_TRUE(found(counted(ripple)).empty());
}

TEST(Held, WeightIsSmoothAndJoinsWhatTouches) {
    const HeldWeight w({{1, 2}, {2.1, 3}, {5, 6}}, 0.1, 0.2);
    EXPECT_EQ(w.at(0.5), 0);
    EXPECT_EQ(w.at(2.05), 1); // between two that touch
    EXPECT_EQ(w.at(4), 0);
    EXPECT_EQ(w.at(5.5), 1);
    double steepest = 0;
    for (double t = 0; t < 7; t += 1e-3)
        steepest = std::max(steepest, std::abs(w.at(t + 1e-3) - w.at(t)) / 1e-3);
    EXPECT_LT(steepest, 1.9 / 0.2); // of a fifth-order step: 15/8 over its length
}

// Moves that stand for a moment at every reversal, up to 50 Hz. With the stops left in, the same
// models leave 1.1 to 6.8 %.
TEST(Held, ACompleteModelLeavesNextToNothing) {
    const std::string constant = "[effects.constant_torque]\ntorque = 8e-3\n";
    for (const auto& [coulomb, more] : {std::pair{2.1e-2, std::string()}, {2.1e-2, constant}})
        for (const char* move : {"sine:frequency_Hz=5,amplitude=0.66,periods=20",
                                 "sine:frequency_Hz=8,amplitude=0.3,periods=20",
                                 "trapezoid:stroke=1,velocity=10,acceleration=200,cycles=4"}) {
            const Model truth = with_friction(coulomb, more);
            const std::vector<Capture> captures = {simulate(truth, parse_experiment(move), 2)};
            const auto motions = prepare_all(captures, {.band_Hz = 50, .input = Input::automatic});
            const double error = compare(truth, motions).torque_error;
            std::printf("figure: complete model, %s%s, error = %.3f %%\n", move,
                        more.empty() ? "" : " with a constant torque", 100 * error);
            EXPECT_LT(error, 3e-3);
        }
}
