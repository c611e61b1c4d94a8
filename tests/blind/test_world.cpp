// The world of the blind test against closed forms.
#include "blind/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

using namespace blind;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

World bare() {
    World w;
    w.inertia = 1e-5;
    w.period = 125e-6;
    return w;
}

std::vector<double> constant(double torque, double seconds) {
    return std::vector<double>(static_cast<size_t>(seconds / 125e-6), torque);
}

std::vector<double> sine(double amplitude, double f, double seconds) {
    std::vector<double> out = constant(0, seconds);
    for (size_t k = 0; k < out.size(); ++k)
        out[k] = amplitude * std::sin(kTurn * f * static_cast<double>(k) * 125e-6);
    return out;
}

// Fundamental of the last `seconds`, a whole number of cycles; e^{jωt} convention.
std::complex<double> phasor(const std::vector<double>& x, double f, double seconds) {
    const auto n = static_cast<size_t>(std::lround(seconds / 125e-6));
    std::complex<double> sum = 0;
    for (size_t k = x.size() - n; k < x.size(); ++k)
        sum += x[k] * std::polar(1.0, -kTurn * f * static_cast<double>(k) * 125e-6);
    return 2.0 / static_cast<double>(n) * sum;
}

using Plant = std::function<std::complex<double>(std::complex<double>)>; // torque → velocity

// What samples of the velocity say of a held torque: the plant through the hold, with all images.
std::complex<double> sampled(const Plant& plant, double f) {
    std::complex<double> sum = 0;
    for (int k = -200; k <= 200; ++k) {
        const std::complex<double> s(0, kTurn * (f + k * 8000.0));
        sum += plant(s) * (1.0 - std::exp(-s * 125e-6)) / (s * 125e-6);
    }
    return sum;
}

void expect_response(const World& w, const Plant& plant, double f) {
    const Record r = run_open(w, sine(0.05, f, 3), {});
    const auto seen = phasor(r.velocity, f, 1) / phasor(r.asked, f, 1);
    EXPECT_LT(std::abs(seen / sampled(plant, f) - 1.0), 4e-3) << f << " Hz";
}

} // namespace

TEST(BlindWorld, ViscousAndCoulombStopTheAxisWhereTheySay) {
    World w = bare();
    w.viscous_forward = w.viscous_reverse = 1e-4;
    w.coulomb_forward = w.coulomb_reverse = 5e-3;
    const double v0 = 80, c = 5e-3 / 1e-4, rate = 1e-4 / 1e-5;
    const Record r = run_open(w, constant(0, 0.2), {0, v0});
    const double stop = std::log(1 + v0 / c) / rate;
    const double way = (v0 + c) / rate * (1 - std::exp(-rate * stop)) - c * stop;
    const auto half = static_cast<size_t>(0.5 * stop / w.period);
    const double t = static_cast<double>(half) * w.period;
    EXPECT_NEAR(r.velocity[half], (v0 + c) * std::exp(-rate * t) - c, 1e-3);
    EXPECT_NEAR(r.position.back(), way, 1e-5 * way);
    EXPECT_EQ(r.velocity.back(), 0);
    EXPECT_EQ(r.stuck.back(), 1);
}

TEST(BlindWorld, StickingHoldsBelowCoulombAndLetsGoAbove) {
    World w = bare();
    w.coulomb_forward = w.coulomb_reverse = 5e-3;
    EXPECT_EQ(run_open(w, constant(4.99e-3, 0.1), {}).position.back(), 0);
    const Record r = run_open(w, constant(6e-3, 0.1), {});
    const double t = 0.1 - w.period;
    EXPECT_NEAR(r.position.back(), 0.5 * 1e-3 / 1e-5 * t * t, 1e-6);
}

TEST(BlindWorld, ElasticLoadIsEquationSeven) {
    World w = bare();
    w.modes = Modes{kTurn * 402.3, kTurn * 628.9, 0.05, 0.05};
    const Plant plant = [&w](std::complex<double> s) {
        const double a = w.modes->antiresonance, b = w.modes->resonance;
        return b * b / (a * a) / (w.inertia * s) * (s * s + 0.1 * a * s + a * a) /
               (s * s + 0.1 * b * s + b * b);
    };
    for (double f : {50.0, 300.0, 402.0, 629.0, 900.0})
        expect_response(w, plant, f);
}

TEST(BlindWorld, LagAndDeadTimeTurnThePhase) {
    for (double f : {20.0, 100.0, 400.0}) {
        World w = bare();
        w.lag = 0.3e-3;
        expect_response(
            w, [](auto s) { return 1.0 / (1e-5 * s) / (1.0 + 0.3e-3 * s); }, f);
        w.lag = 0;
        w.dead_time = 0.21e-3;
        expect_response(
            w, [](auto s) { return 1.0 / (1e-5 * s) * std::exp(-0.21e-3 * s); }, f);
    }
}

TEST(BlindWorld, BristlesBendAsDahlSays) {
    World w = bare();
    w.bristle_torque = 5e-3;
    w.bristle_stiffness = 0.5;
    w.viscous_forward = w.viscous_reverse = 2e-2; // to settle without swinging
    const Record r = run_open(w, constant(3e-3, 2), {});
    EXPECT_NEAR(r.position.back(), -5e-3 / 0.5 * std::log(1 - 3.0 / 5), 1e-5);
}

TEST(BlindWorld, VaryingInertiaKeepsItsEnergy) {
    World w = bare();
    w.inertia_wave = {0.4, 2, 0.7};
    const Record r = run_open(w, constant(0, 0.5), {0, 60});
    const auto energy = [&](size_t k) {
        return (1 + 0.4 * std::cos(2 * r.position[k] + 0.7)) * r.velocity[k] * r.velocity[k];
    };
    for (size_t k = 0; k < r.size(); k += 100)
        EXPECT_NEAR(energy(k), energy(0), 1e-3 * energy(0));
}

TEST(BlindWorld, GapFreesTheLoadUntilItIsCrossed) {
    World w = bare();
    w.gap = 0.02, w.load_share = 0.6;
    w.contact_rad_s = kTurn * 2000, w.contact_damping = 0.7;
    const double torque = 1e-3, motor = 0.4 * w.inertia;
    const Record r = run_open(w, constant(torque, 0.3), {});
    const double meets = std::sqrt(0.02 / (torque / motor)); // half the gap
    const auto before = static_cast<size_t>(0.8 * meets / w.period);
    EXPECT_NEAR(r.velocity[before], torque / motor * static_cast<double>(before) * w.period, 1e-6);
    // Behind the gap: momentum of both.
    EXPECT_NEAR(r.velocity.back(), torque / w.inertia * (0.3 - w.period), 2e-3);
}

TEST(BlindWorld, StopSpringGravityAndSaturationHoldStill) {
    World w = bare();
    w.viscous_forward = w.viscous_reverse = 2e-3;
    w.spring = 0.01, w.spring_rest = 0.5;
    EXPECT_NEAR(run_open(w, constant(2e-3, 4), {}).position.back(), 0.5 + 0.2, 1e-4);
    w.spring = 0;
    w.stop_position = 0.3, w.stop_stiffness = 0.05;
    EXPECT_NEAR(run_open(w, constant(2e-3, 4), {}).position.back(), 0.3 + 0.04, 1e-4);
    w.delivered_limit = 1e-3;
    EXPECT_NEAR(run_open(w, constant(2e-3, 4), {}).position.back(), 0.3 + 0.02, 1e-4);
    w.delivered_limit = 0, w.stop_stiffness = 0;
    w.gravity = 4e-3, w.gravity_phase = 0.2;
    EXPECT_NEAR(run_open(w, constant(2e-3, 9), {}).position.back(), std::asin(0.5) - 0.2, 1e-4);
}

// The paper's simulation of system 1: a reference of 1 rad, 8th to 10th period.
TEST(BlindWorld, TheLoopIsThePapers) {
    World w = bare();
    w.inertia = 0.116e-4;
    w.viscous_forward = w.viscous_reverse = 0.75e-4;
    w.coulomb_forward = w.coulomb_reverse = 6.6e-3;
    w.position_gain = 40;
    w.speed_gain = 40 * kTurn * 0.116e-4;
    w.integral_time = 4 / (40 * kTurn);
    w.quantum = kTurn / 131072;
    const auto amplitudes = [&](double f) {
        Reference reference = sine(1, f, 10 / f);
        const Record r = run(w, reference);
        return std::pair(std::abs(phasor(r.position, f, 2 / f)),
                         std::abs(phasor(r.asked, f, 2 / f)));
    };
    const auto [low, low_torque] = amplitudes(10);
    EXPECT_NEAR(low, 0.616, 0.004);
    const auto [high, torque] = amplitudes(200);
    EXPECT_NEAR(high, 0.0060, 0.0003);
    EXPECT_NEAR(torque / 0.637, 0.1863, 0.003);
    EXPECT_GT(low_torque, 0);
}
