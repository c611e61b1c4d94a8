// The axis against truth from elsewhere: closed forms, a Taylor matrix exponential in long double,
// and a Runge-Kutta integration a thousand times finer than the step.
#include "plant/axis.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr double kStep = 125e-6;
constexpr double kTurn = 2 * std::numbers::pi;

AxisDescription system_1() {
    AxisDescription a;
    a.inertia = 0.116e-4;
    a.viscous_forward = a.viscous_reverse = 0.75e-4;
    return a;
}

AxisDescription system_2() {
    AxisDescription a;
    a.inertia = 0.556e-4;
    a.viscous_forward = a.viscous_reverse = 0.96e-3;
    a.elastic = ElasticLoad{402.3 * kTurn, 628.9 * kTurn, 0.05, 0.05};
    return a;
}

// Eq. (7) with friction, as first-order equations; Coulomb smoothed over 1e-5 rad/s.
using State = std::array<double, 4>;

State slope(const AxisDescription& p, const State& x, double torque) {
    const double sign = x[1] / (std::abs(x[1]) + 1e-5);
    const double tc = x[1] > 0 ? p.coulomb_forward : p.coulomb_reverse;
    const double d = x[1] > 0 ? p.viscous_forward : p.viscous_reverse;
    const double u = torque - p.constant_torque - d * x[1] - tc * sign;
    if (!p.elastic) return {x[1], u / p.inertia, 0, 0};
    const double wa = p.elastic->antiresonance_rad_s, wr = p.elastic->resonance_rad_s;
    const double za = p.elastic->antiresonance_damping, zr = p.elastic->resonance_damping;
    // z'' + 2ζrωr z' + ωr² z = u; a = (ωr²/ωa²)/J (z'' + 2ζaωa z' + ωa² z)
    const double zz = u - 2 * zr * wr * x[3] - wr * wr * x[2];
    const double a = wr * wr / (wa * wa) / p.inertia * (zz + 2 * za * wa * x[3] + wa * wa * x[2]);
    return {x[1], a, x[3], zz};
}

State runge_kutta(const AxisDescription& p, State x, double torque, double h) {
    auto moved = [&](const State& by, double f) {
        State y = x;
        for (size_t i = 0; i < 4; ++i)
            y[i] += f * by[i];
        return y;
    };
    const State k1 = slope(p, x, torque), k2 = slope(p, moved(k1, h / 2), torque),
                k3 = slope(p, moved(k2, h / 2), torque), k4 = slope(p, moved(k3, h), torque);
    for (size_t i = 0; i < 4; ++i)
        x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return x;
}

double input(int i) { return 0.1 * std::sin(0.03 * i) + 0.05 * std::sin(0.4 * i); }

// Largest difference of position over the largest position, and the same for velocity.
std::array<double, 2> against_runge_kutta(const AxisDescription& p, int steps, int fine) {
    Axis axis(p, kStep);
    State x{};
    double dp = 0, dv = 0, p_top = 0, v_top = 0;
    for (int i = 0; i < steps; ++i) {
        axis.step(input(i));
        for (int k = 0; k < fine; ++k)
            x = runge_kutta(p, x, input(i), kStep / fine);
        dp = std::max(dp, std::abs(axis.position() - x[0]));
        dv = std::max(dv, std::abs(axis.velocity() - x[1]));
        p_top = std::max(p_top, std::abs(x[0])), v_top = std::max(v_top, std::abs(x[1]));
    }
    return {dp / p_top, dv / v_top};
}

} // namespace

TEST(Axis, ViscousStepIsTheClosedForm) {
    Axis axis(system_1(), kStep);
    const AxisDescription p = system_1();
    const double torque = 0.2, rate = p.viscous_forward / p.inertia;
    for (int i = 1; i <= 4000; ++i) {
        axis.step(torque);
        const double t = i * kStep;
        const double v = torque / p.viscous_forward * -std::expm1(-rate * t);
        const double x = torque / p.viscous_forward * (t + std::expm1(-rate * t) / rate);
        ASSERT_NEAR(axis.velocity(), v, 1e-11 * v) << "step " << i;
        ASSERT_NEAR(axis.position(), x, 1e-11 * x + 1e-15) << "step " << i;
    }
}

TEST(Axis, CoulombStopsWhereTheClosedFormSays) {
    AxisDescription p = system_1();
    p.viscous_forward = p.viscous_reverse = 0;
    p.coulomb_forward = p.coulomb_reverse = 6.6e-3;
    for (double v0 : {0.001, 0.07, 1.0, -3.3, 40.0}) {
        Axis axis(p, kStep);
        axis.set_state(0, v0);
        for (int i = 0; i < 2000; ++i)
            axis.step(0);
        const double stop = v0 * std::abs(v0) * p.inertia / (2 * p.coulomb_forward);
        EXPECT_NEAR(axis.position(), stop, 1e-9 * std::abs(stop)) << "v0 " << v0;
        EXPECT_EQ(axis.velocity(), 0) << "v0 " << v0;
        EXPECT_TRUE(axis.stuck());
    }
}

TEST(Axis, StickingHoldsBelowAndBreaksAwayAboveCoulomb) {
    AxisDescription p = system_1();
    p.coulomb_forward = 6e-3, p.coulomb_reverse = 3e-3;
    p.constant_torque = 1e-3;
    Axis axis(p, kStep);
    for (double torque : {6.9e-3, -1.9e-3, 0.0}) {
        for (int i = 0; i < 100; ++i)
            axis.step(torque);
        EXPECT_EQ(axis.position(), 0) << torque;
    }
    axis.step(7.1e-3);
    EXPECT_GT(axis.velocity(), 0);
    Axis other(p, kStep);
    other.step(-2.1e-3);
    EXPECT_LT(other.velocity(), 0);
}

TEST(Axis, ElasticAxisIsRungeKuttaWithoutFriction) {
    const auto [position, velocity] = against_runge_kutta(system_2(), 4000, 400);
    EXPECT_LT(position, 1e-9);
    EXPECT_LT(velocity, 1e-9);
}

TEST(Axis, CoulombWithStickingIsAFineRungeKutta) {
    AxisDescription rigid = system_1();
    rigid.coulomb_forward = rigid.coulomb_reverse = 6.6e-3;
    AxisDescription elastic = system_2();
    elastic.coulomb_forward = 2.1e-2, elastic.coulomb_reverse = 1.5e-2;
    for (const AxisDescription& p : {rigid, elastic}) {
        const auto [position, velocity] = against_runge_kutta(p, 1500, 2000);
        EXPECT_LT(position, 2e-4) << (p.elastic ? "eq. (7)" : "eq. (6)");
        EXPECT_LT(velocity, 2e-4) << (p.elastic ? "eq. (7)" : "eq. (6)");
    }
}

TEST(Axis, AntiresonanceAndResonanceAreThoseOfEquationSeven) {
    AxisDescription p = system_2();
    p.viscous_forward = p.viscous_reverse = 0;
    for (double f : {10.0, 200.0, 402.3, 628.9}) {
        Axis axis(p, kStep / 16); // a fine hold, so that the held sine is nearly a sine
        const double w = f * kTurn;
        const long settle = long(1.0 / (kStep / 16)), window = long(std::lround(16 / (f * kStep)));
        std::complex<double> sum = 0;
        for (long i = 0; i < settle + 4 * window; ++i) {
            const double t = double(i) * kStep / 16;
            if (i >= settle) sum += axis.velocity() * std::polar(1.0, -w * t);
            axis.step(std::cos(w * (t + kStep / 32)));
        }
        const std::complex<double> s(0, w);
        const ElasticLoad& e = *p.elastic;
        const double wa = e.antiresonance_rad_s, wr = e.resonance_rad_s;
        const std::complex<double> g = wr * wr / (wa * wa) / p.inertia / s *
                                       (s * s + 2 * e.antiresonance_damping * wa * s + wa * wa) /
                                       (s * s + 2 * e.resonance_damping * wr * s + wr * wr);
        const double measured = std::abs(2.0 * sum / double(4 * window));
        EXPECT_NEAR(measured / std::abs(g), 1, 0.02) << f << " Hz";
    }
}

TEST(Axis, WrongDescriptionsAreRefused) {
    AxisDescription p = system_1();
    p.inertia = -1;
    EXPECT_THROW(Axis(p, kStep), std::invalid_argument);
    EXPECT_THROW(Axis(system_1(), 0), std::invalid_argument);
}
