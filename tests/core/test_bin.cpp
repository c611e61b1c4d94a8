#include "reference_fit.hpp"

#include <gtest/gtest.h>

namespace {

struct Signal {
    double cosine[2] = {120000, -3000}, sine[2] = {-45000, 80000};
    double trend[2][4] = {};
};

struct Window {
    std::vector<int32_t> torque, position;
    sid_bin_t bin{};
};

Window measure(const Signal& s, uint64_t increment, uint64_t phase, uint32_t n) {
    Window w;
    EXPECT_TRUE(sid_bin_start(&w.bin, increment, phase, n));
    for (uint32_t i = 0; i < n; i++) {
        const double angle = 2 * M_PI * double(phase + increment * i) / 18446744073709551616.0;
        const double t = 2.0 * i / (n - 1) - 1;
        double y[2];
        for (int c = 0; c < 2; c++)
            y[c] = s.cosine[c] * std::cos(angle) + s.sine[c] * std::sin(angle) + s.trend[c][0] +
                   t * (s.trend[c][1] + t * (s.trend[c][2] + t * s.trend[c][3]));
        w.torque.push_back(int32_t(std::lround(y[0])));
        w.position.push_back(int32_t(std::lround(y[1])));
        sid_bin_step(&w.bin, w.torque.back(), w.position.back());
    }
    while (!sid_bin_gram_advance(&w.bin, 100)) {
    }
    return w;
}

TEST(Bin, FindsASineUnderACubicTrendInAWindowOfNoWholePeriods) {
    for (double f : {10.0, 30.0, 77.7, 133.0, 200.0})
        for (double periods : {1.3, 2.0, 2.37, 5.5}) {
            Signal s;
            for (int c = 0; c < 2; c++)
                for (int k = 0; k < 4; k++)
                    s.trend[c][k] = 1e5 * (c + 1) * (k % 2 ? -1 : 1);
            const uint64_t increment = increment_of(f);
            const uint32_t n = uint32_t(std::lround(periods * 8000 / f));
            Window w = measure(s, increment, 0x123456789ABCDEF0ULL, n);
            sid_bin_result_t r;
            ASSERT_EQ(sid_bin_solve(&w.bin, SID_BIN_CUBIC, &r), SID_BIN_OK) << f << " " << periods;
            const double tolerance = 3 / std::sqrt(value(r.smallest_pivot));
            for (int c = 0; c < 2; c++) {
                EXPECT_NEAR(value(r.cosine[c]), s.cosine[c], tolerance) << f << " Hz " << periods;
                EXPECT_NEAR(value(r.sine[c]), s.sine[c], tolerance);
                EXPECT_NEAR(std::sqrt(value(r.residual[c]) / n), 0.29, 0.12) << "rounding noise";
            }
        }
}

TEST(Bin, AgreesWithAnIndependentFitForEveryOrder) {
    std::mt19937 random(seed_of("bin"));
    std::normal_distribution<double> noise(0, 1);
    double worst = 0;
    for (int run = 0; run < 40; run++) {
        Signal s;
        for (int c = 0; c < 2; c++) {
            s.cosine[c] = 1e5 * noise(random);
            s.sine[c] = 1e5 * noise(random);
            for (double& k : s.trend[c])
                k = 3e5 * noise(random);
        }
        const uint64_t increment = increment_of(10 + double(random() % 190));
        const uint32_t n =
            uint32_t((1.5 + (random() % 300) / 100.0) * 18446744073709551616.0 / double(increment));
        const uint64_t phase = uint64_t(random()) << 32;
        Window w = measure(s, increment, phase, n);
        for (int order = 0; order <= 3; order++) {
            sid_bin_result_t r;
            ASSERT_EQ(sid_bin_solve(&w.bin, sid_bin_method_t(SID_BIN_CONSTANT - order), &r),
                      SID_BIN_OK);
            const std::vector<int32_t>* data[2] = {&w.torque, &w.position};
            for (int c = 0; c < 2; c++) {
                const Fit fit = reference_fit(*data[c], increment, phase, order);
                const double scale = std::hypot(double(fit.cosine), double(fit.sine));
                worst = std::max({worst, std::fabs(value(r.cosine[c]) - double(fit.cosine)) / scale,
                                  std::fabs(value(r.sine[c]) - double(fit.sine)) / scale});
                // The trend's regressors are Q23: a part in 10^7 of the signal is residual of ours
                //             alone.
                EXPECT_NEAR(value(r.residual[c]) / double(fit.residual), 1, 0.1);
            }
        }
    }
    std::printf("  worst coefficient, relative to its amplitude: %.2g\n", worst);
    EXPECT_LT(worst, 3e-6);
}

TEST(Bin, PlainDftIsTheTextbooks) {
    Signal s;
    s.trend[1][0] = 12345;
    Window w = measure(s, increment_of(50), 0, 320);
    sid_bin_result_t r;
    ASSERT_EQ(sid_bin_solve(&w.bin, SID_BIN_PLAIN_DFT, &r), SID_BIN_OK);
    EXPECT_NEAR(value(r.cosine[0]), s.cosine[0], 1);
    EXPECT_NEAR(value(r.sine[1]), s.sine[1], 1);
    EXPECT_LT(value(r.residual[1]) / 320, 1e4) << "mean and sine taken out";
    // mean(T theta) = half the real product for pure sines over whole periods
    EXPECT_NEAR(value(r.product_mean) / ((s.cosine[0] * s.cosine[1] + s.sine[0] * s.sine[1]) / 2),
                1, 1e-5);
    // A trend is what it does not know.
    s.trend[1][1] = 50000;
    w = measure(s, increment_of(50), 0, 320);
    sid_bin_solve(&w.bin, SID_BIN_PLAIN_DFT, &r);
    EXPECT_GT(std::fabs(value(r.sine[1]) - s.sine[1]), 1000);
}

TEST(Bin, EverySumStaysBelowTwoToThe62) {
    // The worst there is: extreme samples whose signs follow a regressor, at the largest N; against
    // 128-bit sums.
    for (int follow = 0; follow < SID_BIN_REGRESSORS; follow++) {
        sid_bin_t bin;
        const uint64_t increment = increment_of(0.25);
        ASSERT_TRUE(sid_bin_start(&bin, increment, 0, 65535));
        __int128 exact[SID_BIN_SUMS] = {};
        for (uint32_t i = 0; i < 65535; i++) {
            const sid_bin_row_t row = sid_bin_row(sid_osc(increment * i), sid_bin_tau(&bin, i));
            for (int r = 0; r < SID_BIN_REGRESSORS; r++)
                ASSERT_LE(std::abs(row.value[r]), 1 << 23);
            const int32_t y = row.value[follow] < 0 ? INT32_MIN : INT32_MAX;
            const int64_t clamped = y < 0 ? -8388607 : 8388607;
            sid_bin_step(&bin, y, y);
            for (int r = 0; r < SID_BIN_REGRESSORS; r++)
                for (int c = 0; c < 2; c++)
                    exact[SID_BIN_SUM(r, c)] += __int128(clamped) * row.value[r];
            for (int k = 12; k < 15; k++)
                exact[k] += __int128(clamped) * clamped;
        }
        for (int k = 0; k < SID_BIN_SUMS; k++) {
            EXPECT_TRUE(exact[k] == bin.sums[k]) << k;
            EXPECT_LT(std::fabs(double(bin.sums[k])), 4611686018427387904.0);
        }
        EXPECT_GT(bin.sums[SID_BIN_SQUARE(0)], 4.6e18) << "the bound is nearly reached";
        EXPECT_EQ(bin.torque_clamped, 65535u);
        EXPECT_EQ(bin.position_clamped, 65535u);
        while (!sid_bin_gram_advance(&bin, 5000)) {
        }
        for (int64_t g : bin.gram)
            EXPECT_LT(std::fabs(double(g)), 4611686018427387904.0);
    }
}

TEST(Bin, ReplayInPortionsGivesTheSameGram) {
    sid_bin_t a, b;
    ASSERT_TRUE(sid_bin_start(&a, increment_of(37), 99, 1000));
    b = a;
    EXPECT_TRUE(sid_bin_gram_advance(&a, 1000000));
    int polls = 0;
    while (!sid_bin_gram_advance(&b, 7))
        polls++;
    EXPECT_EQ(polls, 142);
    for (int i = 0; i < SID_BIN_GRAM_SUMS; i++)
        EXPECT_EQ(a.gram[i], b.gram[i]);
}

TEST(Bin, OutsideTheWindowNothingChanges) {
    sid_bin_t bin;
    ASSERT_TRUE(sid_bin_start(&bin, increment_of(100), 0, 160));
    for (int i = 0; i < 160; i++)
        sid_bin_step(&bin, 1000 * i, -i);
    const sid_bin_t before = bin;
    for (int i = 0; i < 1000; i++)
        sid_bin_step(&bin, INT32_MAX, INT32_MIN);
    for (int k = 0; k < SID_BIN_SUMS; k++)
        EXPECT_EQ(before.sums[k], bin.sums[k]);
    EXPECT_EQ(bin.torque_clamped, 0u);
}

TEST(Bin, RefusesWhatItCannotAnswer) {
    sid_bin_t bin;
    sid_bin_result_t r;
    EXPECT_FALSE(sid_bin_start(&bin, increment_of(10), 0, 7));
    EXPECT_FALSE(sid_bin_start(&bin, increment_of(10), 0, 65536));
    EXPECT_FALSE(sid_bin_start(&bin, 0, 0, 100));
    EXPECT_FALSE(sid_bin_start(&bin, 1ULL << 63, 0, 100));
    sid_bin_step(&bin, 1, 1);
    EXPECT_EQ(sid_bin_solve(&bin, SID_BIN_CUBIC, &r), SID_BIN_INCOMPLETE);
    ASSERT_TRUE(sid_bin_start(&bin, increment_of(10), 0, 700)); // 0.875 periods
    for (int i = 0; i < 700; i++)
        sid_bin_step(&bin, i, i);
    EXPECT_EQ(sid_bin_solve(&bin, SID_BIN_CUBIC, &r), SID_BIN_INCOMPLETE) << "no replay yet";
    sid_bin_gram_advance(&bin, 700);
    EXPECT_EQ(sid_bin_solve(&bin, SID_BIN_CUBIC, &r), SID_BIN_SHORT);
    ASSERT_TRUE(
        sid_bin_start(&bin, (1ULL << 63) - 1, 0, 100)); // just below half the rate: sin vanishes
    for (int i = 0; i < 100; i++)
        sid_bin_step(&bin, i, i);
    sid_bin_gram_advance(&bin, 100);
    EXPECT_EQ(sid_bin_solve(&bin, SID_BIN_CUBIC, &r), SID_BIN_ILL_CONDITIONED);
    EXPECT_EQ(r.cosine[0].mantissa, 0);
}

} // namespace
