// Known noise on a torque that repeats: the floor is that noise, through the same band.
#include "compare/noise_floor.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace servoid;

namespace {

constexpr double kPeriod = 2.0;
constexpr double kInertia = 0.01;
constexpr double kBand = 40;

struct Made {
    Capture capture;
    std::vector<double> noise;
};

// Torque of an inertia, something a model does not know (which repeats), and noise.
Made with_noise(double sigma, double periods, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss(0, 1);
    Made out;
    out.capture = sampled(
        [&](const Kinematics& k, double) {
            out.noise.push_back(sigma * gauss(random));
            return kInertia * k.acceleration + 0.1 * std::tanh(k.velocity) + out.noise.back();
        },
        periods * kPeriod);
    out.capture.period_s = kPeriod;
    return out;
}

// All of the torque but the inertia is residual.
Eigen::VectorXd residual_of(const PreparedMotion& m) {
    return m.torque - kInertia * m.acceleration;
}

// What the noise alone is after the band limit, as a share of the torque.
double true_ratio(const PreparedMotion& m, const std::vector<double>& noise) {
    const Eigen::Map<const Eigen::VectorXd> raw(noise.data(), Eigen::Index(noise.size()));
    const Eigen::VectorXd limited = LowPass(m.capture->sample_time_s, kBand).apply(raw, m.grid);
    return limited.norm() / m.torque.norm();
}

TEST(NoiseFloor, KnownNoiseIsFound) {
    double mean = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const Made made = with_noise(0.02, 8, seed);
        const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
        const NoiseFloor floor = noise_floor(m, residual_of(m), kInertia);
        EXPECT_TRUE(floor.from_repetition);
        EXPECT_GE(floor.periods, 7);
        const double ratio = floor.ratio / true_ratio(m, made.noise);
        EXPECT_NEAR(ratio, 1, 0.15);
        mean += ratio / 20;
    }
    EXPECT_NEAR(mean, 1, 0.03);
}

// Few periods share their mean with the noise: P/(P−1) puts that right.
TEST(NoiseFloor, FewPeriodsAreNoLower) {
    double mean = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const Made made = with_noise(0.02, 2.4, seed);
        const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
        const NoiseFloor floor = noise_floor(m, residual_of(m), kInertia);
        EXPECT_EQ(floor.periods, 2);
        mean += std::pow(floor.ratio / true_ratio(m, made.noise), 2) / 60;
    }
    EXPECT_NEAR(mean, 1, 0.06);
}

TEST(NoiseFloor, RepeatableShareIsTheRest) {
    const Made made = with_noise(0.02, 8, 3);
    const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
    const Eigen::VectorXd residual = residual_of(m);
    const double noise = true_ratio(m, made.noise) * m.torque.norm() / residual.norm();
    EXPECT_NEAR(noise_floor(m, residual, kInertia).repeatable_share, 1 - noise * noise, 0.01);
}

TEST(NoiseFloor, WithoutNoiseThereIsNone) {
    const Made made = with_noise(0, 6, 1);
    const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
    const NoiseFloor floor = noise_floor(m, residual_of(m), kInertia);
    EXPECT_LT(floor.ratio, 1e-3);
    EXPECT_GT(floor.repeatable_share, 0.999);
}

// A start that differs from the rest is no noise: it counts as a transient.
TEST(NoiseFloor, StartTransientIsLeftOut) {
    Made made = with_noise(0.02, 8, 5);
    for (size_t i = 0; i < 1500; ++i)
        made.capture.torque_ref[i] += 0.8 * std::exp(-double(i) / 400);
    const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
    const NoiseFloor floor = noise_floor(m, residual_of(m), kInertia);
    EXPECT_EQ(floor.periods, 6);
    EXPECT_NEAR(floor.ratio / true_ratio(m, made.noise), 1, 0.1);
}

// Nothing repeats: the step of the encoder, carried through the inertia.
TEST(NoiseFloor, QuantisationWhereNothingRepeats) {
    Made made = with_noise(0, 1.5, 1);
    made.capture.period_s.reset();
    made.capture.position_quantum = 1e-4;
    const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
    const NoiseFloor floor = noise_floor(m, residual_of(m), kInertia);
    EXPECT_FALSE(floor.from_repetition);
    EXPECT_TRUE(std::isnan(floor.repeatable_share));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> step(-0.5e-4, 0.5e-4);
    Eigen::VectorXd error(Eigen::Index(made.capture.rows()));
    for (double& e : error)
        e = step(random);
    const Eigen::VectorXd jerked =
        kInertia * LowPass(made.capture.sample_time_s, kBand).apply(error, m.grid, 2);
    EXPECT_NEAR(floor.ratio / (jerked.norm() / m.torque.norm()), 1, 0.1);
}

} // namespace
