// Noise is there all the time. What comes in bursts is something that nobody has named.
#include "compare/compare.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/evidence.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr unsigned kSeed = 20261122;
constexpr double kStep_s = 1e-3, kBand_Hz = 30;
constexpr int kRows = 10000, kHeld = 10;

// Sines of one acceleration: a lag that took up noise would show in the fastest of them.
Kinematics sines(double t) {
    constexpr double acceleration = 100; // rad/s²
    Kinematics out;
    for (const double frequency_Hz : {1.13, 3.41, 7.77, 14.9}) {
        const double w = 2 * std::numbers::pi * frequency_Hz, a = acceleration / (w * w);
        out.position += a * std::sin(w * t), out.velocity += a * w * std::cos(w * t);
        out.acceleration -= a * w * w * std::sin(w * t);
    }
    return out;
}

// Disturbance of each row, N·m: white within the band, for `width` rows of every `every`.
std::vector<double> disturbance(double rms, int width, int every) {
    std::mt19937 random(kSeed);
    std::normal_distribution<double> gauss(0, rms * std::sqrt(double(every) / width));
    std::uniform_int_distribution<int> place(0, every - width);
    std::vector<double> out(kRows, 0.0);
    for (int from = 0; from < kRows; from += every)
        for (int first = from + place(random), i = first; i < first + width; ++i)
            out[size_t(i)] = (i - first) % kHeld ? out[size_t(i - 1)] : gauss(random);
    return out;
}

Capture disturbed(const std::vector<double>& by) {
    Capture c;
    c.path = "made";
    c.sample_time_s = kStep_s;
    c.ref_held = false;
    c.period_s = kRows * kStep_s; // as long as the record: nothing repeats
    for (int i = 0; i < kRows; ++i) {
        const Kinematics k = sines(i * kStep_s);
        c.time_s.push_back(i * kStep_s), c.position.push_back(k.position);
        c.torque_ref.push_back(rigid_torque(k) + by[size_t(i)]);
    }
    return c;
}

Diagnosis diagnosed(double rms, int width, int every) {
    const std::vector<Capture> captures = {disturbed(disturbance(rms, width, every))};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {kBand_Hz, {}});
    Diagnosis d = diagnose(rigid_axis(kInertia, kViscous, kOffset), motions);
    std::printf("figure: %d rows of %d: %s, torque error %.3g %%, peakedness %.3g\n", width, every,
                verdict_name(d.verdict), 100 * d.error_before, peakedness(d.before.residual));
    return d;
}

} // namespace

TEST(Peakedness, OfNoiseOfASineAndOfBursts) {
    std::mt19937 random(kSeed);
    std::normal_distribution<double> gauss;
    constexpr Eigen::Index n = 50000; // standard deviation of the fourth moment √(24/n) = 0.022
    const Eigen::VectorXd noise = Eigen::VectorXd::NullaryExpr(n, [&] { return gauss(random); });
    EXPECT_NEAR(peakedness(noise), 3, 0.1) << "seed " << kSeed;
    EXPECT_NEAR(peakedness(7 * noise), peakedness(noise), 1e-9);
    const Eigen::VectorXd sine = Eigen::VectorXd::NullaryExpr(
        n, [](Eigen::Index i) { return std::sin(2 * std::numbers::pi * double(i) / 1000); });
    EXPECT_NEAR(peakedness(sine), 1.5, 1e-9);
    Eigen::VectorXd bursts = noise; // a share s of the time: 3/s
    for (Eigen::Index i = 0; i < n; ++i)
        if (i % 1000 >= 20) bursts[i] = 0;
    EXPECT_NEAR(peakedness(bursts) / 150, 1, 0.3) << "seed " << kSeed;
    EXPECT_EQ(peakedness(Eigen::VectorXd::Zero(10)), 0);
}

TEST(Bursts, ATenthOfTheTorqueInBurstsIsUnknown) {
    const Diagnosis d = diagnosed(0.3, 100, 500);
    EXPECT_GT(d.error_before, 0.1);
    EXPECT_GT(peakedness(d.before.residual), 6);
    EXPECT_EQ(d.verdict, Verdict::unknown) << d.advice;
}

TEST(Bursts, AsMuchOfSteadyNoiseIsNoise) {
    const Diagnosis d = diagnosed(0.3, 500, 500);
    EXPECT_GT(d.error_before, 0.1);
    EXPECT_LT(peakedness(d.before.residual), 4);
    EXPECT_EQ(d.verdict, Verdict::adequate) << d.advice;
}

TEST(Bursts, AFewPerCentInBurstsAreNoise) {
    const Diagnosis d = diagnosed(0.15, 100, 500);
    EXPECT_LT(d.error_before, 0.1);
    EXPECT_GT(peakedness(d.before.residual), 6);
    EXPECT_EQ(d.verdict, Verdict::adequate) << d.advice;
}
