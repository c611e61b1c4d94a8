#include "reference_fit.hpp"

#include <gtest/gtest.h>

namespace {

sid_result_t solve(const sid_bin_t& bin, sid_inertia_config_t config = {}) {
    sid_result_t r;
    sid_inertia_solve(&bin, &config, &r);
    return r;
}

// Position A cos p exactly, torque from J, D and an offset, with the wanted timing of the torque.
sid_bin_t plant(double inertia, double viscous, double f, double amplitude,
                double delay_samples = 0, double hold = 1) {
    const uint64_t increment = increment_of(f);
    const double w = 2 * M_PI * double(increment) / 18446744073709551616.0;
    const uint32_t n = uint32_t(2 * 8000 / f);
    sid_bin_t bin;
    EXPECT_TRUE(sid_bin_start(&bin, increment, 0, n));
    for (uint32_t i = 0; i < n; i++) {
        const double p = w * i, q = w * (i + delay_samples);
        const double torque =
            (-w * w * inertia * std::cos(q) - w * viscous * std::sin(q)) * amplitude / hold;
        sid_bin_step(&bin, int32_t(std::lround(torque * 1048576)),
                     int32_t(std::lround(amplitude * std::cos(p))));
    }
    sid_bin_gram_advance(&bin, n);
    return bin;
}

TEST(Inertia, SignsAndUnitsOfAKnownPlant) {
    const sid_result_t r = solve(plant(2e-4, 3e-5, 100, 400000));
    ASSERT_EQ(r.reason, SID_OK);
    EXPECT_NEAR(value(r.inertia) / 2e-4, 1, 1e-5);
    EXPECT_NEAR(value(r.viscous) / 3e-5, 1, 1e-4);
    EXPECT_NEAR(value(r.position_amplitude), 400000, 1);
    EXPECT_FALSE(r.std_known);
}

TEST(Inertia, KnownTimingOfTheTorqueIsTakenOut) {
    // Set at sample k and held until k + 1: it acts half a sample later, and weaker by the hold.
    const double w = 2 * M_PI * 200 / 8000, hold = std::sin(w / 2) / (w / 2);
    sid_inertia_config_t config{};
    config.torque_timing = SID_TORQUE_HELD_NEXT;
    sid_result_t r = solve(plant(2e-4, 3e-5, 200, 200000, 0.5, hold), config);
    EXPECT_NEAR(value(r.inertia) / 2e-4, 1, 1e-5);
    EXPECT_NEAR(value(r.viscous) / 3e-5, 1, 1e-3);
    config.torque_timing = SID_TORQUE_HELD_LAST;
    r = solve(plant(2e-4, 3e-5, 200, 200000, -0.5, hold), config);
    EXPECT_NEAR(value(r.inertia) / 2e-4, 1, 1e-5);
    EXPECT_NEAR(value(r.viscous) / 3e-5, 1, 1e-3);
    r = solve(plant(2e-4, 3e-5, 200, 200000, -0.5, hold));
    EXPECT_GT(std::fabs(value(r.inertia) / 2e-4 - 1), 1e-3) << "and it is not nothing";
}

TEST(Inertia, ReasonsFromTheBin) {
    EXPECT_EQ(solve(plant(-2e-4, 0, 100, 400000)).reason, SID_NEGATIVE_INERTIA);
    EXPECT_EQ(value(solve(plant(-2e-4, 0, 100, 400000)).inertia), 0);
    EXPECT_EQ(solve(plant(2e-4, 0, 100, 1)).reason, SID_NO_EXCITATION);
    EXPECT_EQ(solve(plant(1e-12, 0, 100, 400000)).reason, SID_NO_EXCITATION);
    EXPECT_EQ(solve(plant(2e-4, 0, 100, 9000000)).reason, SID_STROKE_CLIPPED);
    EXPECT_EQ(solve(plant(1, 0, 100, 400000)).reason, SID_OVERFLOW);
    sid_inertia_config_t saturated{};
    saturated.saturated_samples = 1;
    EXPECT_EQ(solve(plant(2e-4, 0, 100, 400000), saturated).reason, SID_SATURATED);
    sid_bin_t bin = plant(2e-4, 0, 100, 400000);
    bin.index = 10;
    EXPECT_EQ(solve(bin).reason, SID_WINDOW_TOO_SHORT);
    ASSERT_TRUE(sid_bin_start(&bin, (1ULL << 63) - 1, 0, 100));
    for (int i = 0; i < 100; i++)
        sid_bin_step(&bin, i, i);
    sid_bin_gram_advance(&bin, 100);
    EXPECT_EQ(solve(bin).reason, SID_ILL_CONDITIONED);
    for (int reason = 0; reason < SID_REASON_COUNT; reason++)
        EXPECT_STRNE(sid_reason_text(sid_reason_t(reason)), "unknown");
    EXPECT_STREQ(sid_reason_text(sid_reason_t(99)), "unknown");
    EXPECT_STREQ(sid_reason_text(sid_result_t{}.reason == SID_NOT_RUN ? SID_NOT_RUN : SID_OK),
                 "not run");
}

TEST(Inertia, DeviationOfTheMeanOverWindows) {
    std::mt19937 random(seed_of("windows"));
    std::normal_distribution<double> noise(1, 0.01);
    for (int n = 2; n <= 8; n++) {
        sid_result_t mean{};
        std::vector<double> x;
        for (int i = 0; i < n; i++) {
            sid_result_t w{};
            w.windows = 1;
            w.reason = SID_OK;
            x.push_back(3e-7 * noise(random));
            w.inertia = scaled(x.back());
            w.viscous = scaled(2 * x.back());
            sid_inertia_combine(&mean, &w);
        }
        sid_inertia_finish(&mean);
        double sum = 0, square = 0;
        for (double v : x)
            sum += v / n;
        for (double v : x)
            square += (v - sum) * (v - sum);
        const double std = std::sqrt(square / (n - 1) / n);
        EXPECT_TRUE(mean.std_known);
        EXPECT_EQ(mean.windows, n);
        EXPECT_NEAR(value(mean.inertia) / sum, 1, 1e-8);
        EXPECT_NEAR(value(mean.inertia_std) / std, 1, 1e-5);
        EXPECT_NEAR(value(mean.viscous_std) / (2 * std), 1, 1e-5);
    }
}

// The paper's experiment with the core's own loop and a simulated axis: J from the fixed-point sums
//             against a
// long double fit of the very same samples.
TEST(Inertia, FixedPointAgainstDoubleOnTheSameSamples) {
    double worst = 0;
    for (int system = 1; system <= 2; system++)
        for (int bits : {15, 17, 20, 22, 24})
            for (double f : {10.0, 30.0, 50.0, 100.0, 150.0, 200.0}) {
                Axis axis = system == 1 ? system_1(bits) : system_2(bits);
                sid_loop_t loop;
                const sid_loop_config_t config = paper_loop(axis);
                ASSERT_TRUE(sid_loop_init(&loop, &config));
                const uint64_t increment = increment_of(f);
                const uint32_t start = sid_samples_of_periods(2048, increment);
                const uint32_t n = sid_samples_of_periods(512, increment);
                std::vector<int32_t> torque, position;
                sid_bin_t bin;
                ASSERT_TRUE(sid_bin_start(&bin, increment, increment * start, n));
                for (uint32_t k = 0; k < start + n; k++) {
                    const double r =
                        1 / axis.count_rad() * sid_osc(increment * k).sine_q31 / 2147483648.0;
                    const int32_t p = int32_t(axis.count());
                    const int32_t t = sid_loop_step(&loop, int32_t(std::lround(r * 256)), p);
                    if (k >= start) {
                        sid_bin_step(&bin, t, p);
                        torque.push_back(t);
                        position.push_back(p);
                    }
                    axis.advance(t / 1048576.0 * axis.rated_Nm);
                }
                sid_bin_gram_advance(&bin, n);
                const sid_result_t r = solve(bin);
                ASSERT_EQ(r.reason, SID_OK) << system << " " << bits << " " << f;
                const double j = reference_inertia(
                    reference_fit(torque, increment, increment * start, 3),
                    reference_fit(position, increment, increment * start, 3), increment);
                worst = std::max(worst, std::fabs(value(r.inertia) / j - 1));
                EXPECT_NEAR(value(r.inertia) / j, 1, 1e-4)
                    << system << " " << bits << " bit " << f << " Hz";
                if (system == 1 && bits >= 17) {
                    EXPECT_NEAR(axis.inertia_of(r.inertia) / axis.inertia_kgm2, 1, 0.02)
                        << f << " Hz";
                }
            }
    std::printf("  fixed against long double, worst |dJ|/J: %.2g\n", worst);
}

} // namespace
