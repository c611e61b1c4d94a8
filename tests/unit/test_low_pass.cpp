// The band limit against closed forms: sines, polynomials, white noise.
#include "compare/low_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace servoid;
using Vector = Eigen::VectorXd;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vector sampled(double step_s, Eigen::Index n, double (*f)(double)) {
    Vector x(n);
    for (Eigen::Index i = 0; i < n; ++i)
        x[i] = f(double(i) * step_s);
    return x;
}

Grid inside(const LowPass& low_pass, double length_s, double step_s) {
    const double from = low_pass.half_length_s() + 0.0007;
    return {from, step_s, Eigen::Index((length_s - 2 * from) / step_s)};
}

} // namespace

TEST(LowPass, PassesTheBandWithoutPhaseAtAnyInstant) {
    const double step = 1e-3;
    const Vector x = sampled(step, 4000, [](double t) { return std::sin(kTurn * 11 * t + 0.3); });
    const LowPass low_pass(step, 40);
    const Grid grid = inside(low_pass, 4.0, 0.00613); // never on a sample
    const double w = kTurn * 11;
    const Vector y = low_pass.apply(x, grid), v = low_pass.apply(x, grid, 1),
                 a = low_pass.apply(x, grid, 2);
    for (Eigen::Index k = 0; k < grid.count; ++k) {
        const double phase = w * grid.at(k) + 0.3;
        ASSERT_NEAR(y[k], std::sin(phase), 2e-3);
        ASSERT_NEAR(v[k], w * std::cos(phase), 2e-3 * w);
        ASSERT_NEAR(a[k], -w * w * std::sin(phase), 2e-3 * w * w);
    }
}

TEST(LowPass, StopsAboveTheBand) {
    const double step = 1e-3;
    for (double f : {62.0, 90.0, 200.0, 440.0}) {
        Vector x(4000);
        for (Eigen::Index i = 0; i < x.size(); ++i)
            x[i] = std::sin(kTurn * f * double(i) * step);
        const LowPass low_pass(step, 40);
        const Vector y = low_pass.apply(x, inside(low_pass, 4.0, 0.0061));
        EXPECT_LT(y.cwiseAbs().maxCoeff(), 5e-4) << f << " Hz";
    }
}

TEST(LowPass, PolynomialsAreExact) {
    const double step = 125e-6;
    const Vector x = sampled(step, 8000, [](double t) { return 3 - 2 * t + 5 * t * t; });
    const LowPass low_pass(step, 100);
    const Grid grid = inside(low_pass, 1.0, 0.01);
    const Vector v = low_pass.apply(x, grid, 1), a = low_pass.apply(x, grid, 2);
    for (Eigen::Index k = 0; k < grid.count; ++k) {
        EXPECT_NEAR(v[k], -2 + 10 * grid.at(k), 2e-3);
        EXPECT_NEAR(a[k], 10, 1e-6);
    }
}

TEST(LowPass, HalfASampleOfHoldIsAShift) {
    const double step = 1e-3, w = kTurn * 7;
    Vector x(3000);
    for (Eigen::Index i = 0; i < x.size(); ++i)
        x[i] = std::sin(w * double(i) * step);
    const LowPass low_pass(step, 40);
    const Grid grid = inside(low_pass, 3.0, 0.0103);
    const Vector y = low_pass.apply(x, grid, 0, step / 2);
    for (Eigen::Index k = 0; k < grid.count; ++k)
        ASSERT_NEAR(y[k], std::sin(w * (grid.at(k) - step / 2)), 1e-3);
}

TEST(LowPass, NoiseGainIsWhatWhiteNoiseShows) {
    const unsigned seed = 20261121;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Vector x(200000);
    for (double& value : x)
        value = normal(random);
    const LowPass low_pass(125e-6, 60);
    const Grid grid = inside(low_pass, 25.0, 1.0 / 240);
    for (int derivative : {0, 1, 2}) {
        const Vector y = low_pass.apply(x, grid, derivative);
        const double rms = std::sqrt(y.squaredNorm() / double(y.size()));
        EXPECT_NEAR(rms / low_pass.noise_gain(derivative), 1, 0.04)
            << "derivative " << derivative << ", seed " << seed;
    }
}
