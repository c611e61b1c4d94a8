// Every law of the general engine that has a closed form, against it.
#include "axis_forced.hpp"
#include "plant/axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr double kStep = 125e-6;
constexpr double kTurn = 2 * std::numbers::pi;

AxisDescription plain() {
    AxisDescription a;
    a.inertia = 2e-5;
    a.viscous_forward = a.viscous_reverse = 2e-4;
    return a;
}

} // namespace

// A change of the asked torque by A at t = 0 gives the velocity A/J·(t' − τ(1 − e^(−t'/τ))), t' = t
// − delay.
TEST(AxisClosedForms, LagAndDeadTimeAreTheClosedForm) {
    AxisDescription a;
    a.inertia = 2e-5;
    std::mt19937 random(7);
    std::vector<double> asked(200);
    for (double& torque : asked)
        torque = 1e-3 * (int(random() % 201) - 100);
    for (const double lag : {0.0, 1e-5, 4e-4})
        for (const double delay : {0.0, 0.25, 1.0, 2.37, 7.999}) {
            a.drive.lag_s = lag;
            a.drive.dead_time_s = delay * kStep;
            Axis exact(a, kStep);
            Forced general(a);
            for (size_t i = 0; i < asked.size(); ++i) {
                exact.step(asked[i]), general.step(asked[i]);
                double velocity = 0;
                for (size_t j = 0; j <= i; ++j) {
                    const double t = (double(i + 1 - j) - delay) * kStep;
                    const double change = (asked[j] - (j > 0 ? asked[j - 1] : 0)) / a.inertia;
                    if (t > 0)
                        velocity += change * (t + (lag > 0 ? lag * std::expm1(-t / lag) : 0));
                }
                ASSERT_NEAR(exact.velocity(), velocity, 1e-9) << lag << " s, " << delay;
                ASSERT_NEAR(general.velocity(), velocity, 1e-7) << lag << " s, " << delay;
            }
        }
}

TEST(AxisClosedForms, APendulumTakesItsEllipticPeriod) {
    AxisDescription a;
    a.inertia = 2e-5;
    a.opposing.push_back([](const AxisPoint& p) { return 0.02 * std::sin(p.position); });
    for (const double amplitude : {0.01, 2.0, 3.0}) {
        const double period =
            4 / std::sqrt(0.02 / a.inertia) * std::comp_ellint_1(std::sin(amplitude / 2));
        Axis axis(a, period / 200);
        axis.set_state(amplitude, 0);
        for (int i = 0; i < 10 * 200; ++i)
            axis.step(0);
        EXPECT_NEAR(axis.position(), amplitude, 1e-8 * amplitude);
        EXPECT_NEAR(axis.velocity(), 0, 1e-5 * amplitude); // 10 turns at sqrt(1000) rad/s
    }
}

TEST(AxisClosedForms, ASpringSwingsAtItsFrequencyHoweverStiff) {
    for (const double stiffness : {0.5, 200.0, 2e5}) {
        AxisDescription a;
        a.inertia = 2e-5;
        a.opposing.push_back([=](const AxisPoint& p) { return stiffness * p.position; });
        Axis axis(a, kStep);
        axis.set_state(0.01, 0);
        const double w = std::sqrt(stiffness / a.inertia);
        for (int i = 1; i <= 200; ++i) {
            axis.step(0);
            ASSERT_NEAR(axis.position(), 0.01 * std::cos(w * i * kStep), 1e-4 * 0.01)
                << stiffness << " step " << i;
        }
    }
}

// The energy that Dahl's bristle has taken on the way out, and gives and takes on the way back.
TEST(AxisClosedForms, ABristleFollowsItsLoop) {
    for (const double v0 : {0.2, 1.0, 200.0}) {
        AxisDescription a;
        a.inertia = 2e-5;
        a.bristle = Bristle{20, 1e-2};
        const double top = a.bristle->torque, length = top / a.bristle->stiffness;
        Axis axis(a, kStep);
        axis.set_state(0, v0);
        const auto out = [&](double x) { return top * (x + length * std::expm1(-x / length)); };
        int samples = 0;
        double turn = 0, turn_torque = 0;
        double slowest = 0;
        for (int i = 0; i < 5000; ++i) {
            axis.step(0);
            const double x = axis.position(), v = axis.velocity();
            if (v > 0 && turn > 0) break; // back again
            if (v <= 0 && turn == 0) {
                // Where the energy is spent.
                for (double low = 0, high = 1e3; high - low > 1e-15 * high;) {
                    turn = (low + high) / 2;
                    (out(turn) < a.inertia * v0 * v0 / 2 ? low : high) = turn;
                    if (turn == low && std::nextafter(low, high) >= high) break;
                }
                turn_torque = -top * std::expm1(-turn / length);
            }
            double energy = a.inertia * v0 * v0 / 2 - out(x);
            if (turn > 0) {
                const double way = turn - x;
                energy = -top * way - (turn_torque + top) * length * std::expm1(-way / length);
            }
            ASSERT_NEAR(a.inertia * v * v / 2, energy, 1e-7 * a.inertia * v0 * v0)
                << v0 << " " << i;
            slowest = std::min(slowest, v), ++samples;
        }
        EXPECT_GT(samples, 3) << v0;
        EXPECT_GT(turn, 0) << v0;
        EXPECT_LT(slowest, -0.05) << v0; // it did spring back
    }
}

TEST(AxisClosedForms, TheMotorCrossesTheGapAloneAndTakesTheLoadAlong) {
    AxisDescription a;
    a.inertia = 2e-5;
    a.backlash = Gap{0.01, 0.7};
    const double motor = a.inertia * 0.3, torque = 0.01;
    const double meet = std::sqrt(2 * 0.005 * motor / torque); // half the gap
    const double together = torque * meet / a.inertia;         // momentum is kept
    Axis axis(a, kStep);
    for (int i = 1; i <= 60; ++i) {
        axis.step(torque);
        const double t = i * kStep, after = t - meet;
        const double v = after < 0 ? torque * t / motor : together + torque * after / a.inertia;
        const double x = after < 0
                             ? torque * t * t / motor / 2
                             : 0.005 + together * after + torque * after * after / a.inertia / 2;
        ASSERT_NEAR(axis.velocity(), v, 1e-9) << i;
        ASSERT_NEAR(axis.position(), x, 1e-11) << i;
    }
    // Back: the load coasts, the motor turns round and meets the other face; momentum is T·t.
    double momentum = 60 * kStep * torque;
    for (int turn = 0; turn < 6; ++turn) {
        const double sign = turn % 2 ? 1 : -1;
        for (int i = 0; i < 200; ++i)
            axis.step(sign * torque), momentum += sign * torque * kStep;
        EXPECT_NEAR(axis.velocity(), momentum / a.inertia, 1e-8) << turn;
    }
}

TEST(AxisClosedForms, CoastingOverAVaryingInertiaKeepsTheEnergy) {
    AxisDescription a;
    a.inertia = 2e-5;
    a.inertia_wave = InertiaWave{0.6, 5, 0.4};
    const auto energy = [&](const Axis& axis) {
        return a.inertia * (1 + 0.6 * std::cos(5 * axis.position() + 0.4)) * axis.velocity() *
               axis.velocity() / 2;
    };
    Axis axis(a, kStep);
    axis.set_state(0, 80);
    const double start = energy(axis);
    for (int i = 0; i < 4000; ++i) {
        axis.step(0);
        ASSERT_NEAR(energy(axis), start, 1e-7 * start) << i;
    }
    EXPECT_GT(axis.position(), kTurn);
}

TEST(AxisClosedForms, NothingMovesBelowBreakaway) {
    AxisDescription a = plain();
    a.coulomb_forward = 6e-3, a.coulomb_reverse = 3e-3;
    a.constant_torque = 1e-3;
    a.load_friction = 0.1;
    a.sliding_extra.push_back([](double v) { return 2e-3 * std::exp(-v * v / 0.01); });
    a.opposing.push_back([](const AxisPoint& p) { return 2 * (p.position - 5e-4); });
    // T(1 − μ) reaches 6 + 2 + 1 − 1 mN·m forward, −(3 + 2 − 1 + 1) mN·m reverse.
    const double forward = 8e-3 / 0.9, reverse = -5e-3 / 0.9;
    for (const bool soft : {false, true}) {
        if (soft) a.elastic = ElasticLoad{2000, 3100, 0.05, 0.07};
        Axis axis(a, kStep);
        for (const double torque : {forward - 1e-9, reverse + 1e-9, 0.0}) {
            for (int i = 0; i < 100; ++i)
                axis.step(torque);
            EXPECT_EQ(axis.position(), 0) << torque;
            EXPECT_EQ(axis.velocity(), 0) << torque;
            EXPECT_TRUE(axis.stuck());
        }
        for (const double torque : {forward + 1e-9, reverse - 1e-9}) {
            Axis moving(a, kStep);
            for (int i = 0; i < 100; ++i)
                moving.step(torque);
            EXPECT_GT(moving.position() * torque, 0) << torque;
        }
    }
}

// φ = 1 − 0.5(1 − e^(−t/τ)) falls to T/T_c at t = −τ·ln(2T/T_c − 1), and there the axis leaves.
TEST(AxisClosedForms, FadingFrictionLetsGoAtItsInstant) {
    AxisDescription a;
    a.inertia = 2e-5;
    a.coulomb_forward = a.coulomb_reverse = 0.01;
    a.friction_factor = [](double t) { return 1 + 0.5 * std::expm1(-t / 0.02); };
    const double torque = 0.008, leaves = -0.02 * std::log(2 * 0.8 - 1);
    Axis axis(a, kStep);
    for (int i = 1; i <= 400; ++i) {
        axis.step(torque);
        const double t = i * kStep, dt = std::max(t - leaves, 0.0), tau = 0.02;
        const double v = ((torque - 0.005) * dt +
                          0.005 * tau * std::exp(-leaves / tau) * std::expm1(-dt / tau)) /
                         a.inertia;
        ASSERT_NEAR(axis.velocity(), v, 1e-8) << i;
    }
}
