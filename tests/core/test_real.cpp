#include "support.hpp"

#include <gtest/gtest.h>
extern "C" {
#include "sid_real.h"
}

namespace {

double real(sid_real_t a) { return std::ldexp(double(a >> 12), int32_t(uint32_t(a) << 20) >> 20); }

TEST(Real, OperationsAgreeWithDouble) {
    std::mt19937_64 random(seed_of("real"));
    double worst = 0;
    for (int i = 0; i < 200000; i++) {
        const int64_t m = int64_t(random()) >> (random() % 63),
                      n = int64_t(random()) >> (random() % 63);
        const int e = int(random() % 200) - 100, f = e + int(random() % 80) - 40;
        const sid_real_t a = sid_real_make(m, e), b = sid_real_make(n, f);
        const long double x = ldexpl(m, e), y = ldexpl(n, f);
        const auto near = [&](sid_real_t got, long double exact, long double scale) {
            if (scale == 0) {
                ASSERT_EQ(got, 0);
                return;
            }
            const double error = double(std::fabs((real(got) - exact) / scale));
            worst = std::max(worst, error);
            ASSERT_LT(error, 4e-15);
        };
        near(a, x, x);
        near(sid_real_mul(a, b), x * y, x * y);
        if (n != 0) near(sid_real_div(a, b), x / y, x / y);
        near(sid_real_add(a, b), x + y, std::fmax(std::fabs(x), std::fabs(y)));
        near(sid_real_sub(a, b), x - y, std::fmax(std::fabs(x), std::fabs(y)));
        if (std::fabs(x - y) > 1e-14L * std::fabs(x)) {
            ASSERT_EQ(sid_real_less(a, b), x < y);
        }
        if (m > 0) {
            ASSERT_NEAR(real(sid_real_sqrt(a)) / double(sqrtl(x)), 1, 1e-9);
        }
    }
    std::printf("  worst relative error %.2g\n", worst);
    EXPECT_EQ(sid_real_div(sid_real_make(1, 0), 0), 0);
    EXPECT_EQ(sid_real_sqrt(sid_real_make(-1, 0)), 0);
}

TEST(Real, ExponentsClampInsteadOfWrapping) {
    sid_real_t a = sid_real_make(1, 2000);
    for (int i = 0; i < 5; i++)
        a = sid_real_mul(a, a);
    EXPECT_GT(real(sid_real_shift(a, -1900)), 0);
    EXPECT_EQ(int32_t(uint32_t(a) << 20) >> 20, 2047);
}

TEST(Scaled, RoundTripsAndSaturates) {
    EXPECT_DOUBLE_EQ(value(sid_scaled_make(3, -1)), 1.5);
    EXPECT_NEAR(value(sid_scaled_mul(scaled(M_PI), scaled(-M_E))), -M_PI * M_E, 1e-8);
    EXPECT_NEAR(value(sid_scaled_div(scaled(1e-9), scaled(3e6))), 1e-9 / 3e6, 1e-24);
    EXPECT_EQ(sid_scaled_to_fixed(scaled(1.5), 20), 3 << 19);
    EXPECT_EQ(sid_scaled_to_fixed(scaled(-1e30), 20), INT32_MIN);
    EXPECT_EQ(sid_scaled_to_fixed(scaled(1e30), 20), INT32_MAX);
    EXPECT_EQ(sid_scaled_to_fixed(scaled(1e-30), 20), 0);
}

TEST(Real, LongDivisionIsExact) {
    std::mt19937_64 random(seed_of("divide"));
    for (int i = 0; i < 20000; i++) {
        const uint64_t d = (random() >> (1 + random() % 60)) | 1, high = random() % d,
                       low = random();
        const unsigned __int128 n = ((unsigned __int128)high << 64) | low;
        uint64_t rest = 0;
        ASSERT_EQ(sid_divide_128(high, low, d, &rest), uint64_t(n / d));
        ASSERT_EQ(rest, uint64_t(n % d));
    }
}

} // namespace
