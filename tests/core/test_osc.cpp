#include "support.hpp"

#include <gtest/gtest.h>

namespace {

struct Worst {
    long double sine = 0, cosine = 0;
    void take(uint64_t phase) {
        const sid_osc_t o = sid_osc(phase);
        const long double angle = 2 * M_PIl * (long double)phase / 18446744073709551616.0L;
        sine = std::fmax(sine, std::fabs(o.sine_q31 - 2147483648.0L * sinl(angle)));
        cosine = std::fmax(cosine, std::fabs(o.cosine_q31 - 2147483648.0L * cosl(angle)));
    }
    void check(const char* what) const {
        std::printf("  %s: worst error %.3Lf (sine) %.3Lf (cosine) LSB of Q31\n", what, sine,
                    cosine);
        EXPECT_LE(sine, 2);
        EXPECT_LE(cosine, 2);
        EXPECT_GT(sine, 0.5L); // the measurement itself works
    }
};

TEST(Osc, AtMostTwoLsbOnADenseGrid) {
    Worst worst;
    for (uint64_t i = 0; i < (1U << 20); i++)
        worst.take(i * (1ULL << 44) + (i << 20));
    worst.check("dense");
}

TEST(Osc, AtMostTwoLsbAtRandomPhases) {
    std::mt19937_64 random(seed_of("osc"));
    Worst worst;
    for (int i = 0; i < 1000000; i++)
        worst.take(random());
    worst.check("random");
}

TEST(Osc, AtMostTwoLsbAroundEveryTableEntryAndBoundary) {
    Worst worst;
    for (uint64_t half = 0; half < 256; half++)
        for (int64_t d = -2000; d <= 2000; d++)
            worst.take((half << 56) + uint64_t(d) * 12345677);
    worst.check("seams");
}

TEST(Osc, NothingOverflowsAtThePeaks) {
    for (uint64_t quarter = 0; quarter < 4; quarter++)
        for (int64_t d = -100000; d <= 100000; d++) {
            const sid_osc_t o = sid_osc((quarter << 62) + uint64_t(d) * 4294967311LL);
            const double angle = M_PI_2 * double(quarter);
            ASSERT_NEAR(o.sine_q31 / 2147483648.0, std::sin(angle), 2e-4);
            ASSERT_NEAR(o.cosine_q31 / 2147483648.0, std::cos(angle), 2e-4);
        }
}

TEST(Osc, AtMostTwoLsbAfterAMillionSamples) {
    for (double f : {10.0, 33.3, 200.0, 1234.567}) {
        const uint64_t increment = increment_of(f);
        Worst worst;
        for (uint64_t k = 1000000; k < 1010000; k++) {
            const sid_osc_t o = sid_osc(increment * k);
            // exact phase of f itself, not of the rounded increment
            const long double turns = fmodl((long double)std::llround(f * 1e6) * k / 8e9L, 1);
            worst.sine = std::fmax(worst.sine,
                                   std::fabs(o.sine_q31 - 2147483648.0L * sinl(2 * M_PIl * turns)));
            worst.cosine = std::fmax(
                worst.cosine, std::fabs(o.cosine_q31 - 2147483648.0L * cosl(2 * M_PIl * turns)));
        }
        worst.check("after 1e6 samples");
    }
}

// All of a million samples, at increments whose phases fall on seams of the table, beside them, and
// nowhere twice. Amplitude and phase: what the pair says together.
TEST(Osc, AmplitudeAndPhaseOverAMillionSamples) {
    const uint64_t increments[] = {increment_of(50), increment_of(33.3), increment_of(1234.567),
                                   (1ULL << 57) + 1, (1ULL << 56) - 1,   0x4F1BBCDCBFA53E0BULL,
                                   (1ULL << 63) - 1, 18446744073709ULL};
    long double worst_amplitude = 0, worst_phase = 0;
    for (const uint64_t increment : increments) {
        long double amplitude = 0, phase = 0;
        for (uint64_t k = 0; k <= 1000000; k++) {
            const sid_osc_t o = sid_osc(increment * k);
            const long double angle =
                2 * M_PIl * (long double)(increment * k) / 18446744073709551616.0L;
            const long double s = sinl(angle), c = cosl(angle);
            const long double full = 2147483648.0L;
            amplitude = std::fmax(amplitude, std::fabs(hypotl(o.sine_q31, o.cosine_q31) - full));
            phase = std::fmax(phase, std::fabs(o.sine_q31 * c - o.cosine_q31 * s));
        }
        std::printf("  increment %016llx: amplitude %.3Lf, phase %.3Lf LSB of Q31\n",
                    (unsigned long long)increment, amplitude, phase);
        EXPECT_LE(amplitude, 2);
        EXPECT_LE(phase, 2);
        worst_amplitude = std::fmax(worst_amplitude, amplitude);
        worst_phase = std::fmax(worst_phase, phase);
    }
    std::printf(
        "figure: oscillator over 1e6 samples, 8 increments: amplitude within %.2Lf LSB of Q31, "
        "phase within %.2Lf\n",
        worst_amplitude, worst_phase);
}

TEST(Osc, IncrementIsExactToHalfAnLsb) {
    std::mt19937_64 random(seed_of("increment"));
    for (int i = 0; i < 20000; i++) {
        const uint64_t rate = (random() >> (random() % 62)) | 2;
        if (rate > (1ULL << 63)) continue;
        const uint64_t f = random() % (rate - rate / 2);
        const unsigned __int128 n = (unsigned __int128)f << 64;
        const unsigned __int128 expected = (n + rate / 2) / rate;
        const uint64_t got = sid_phase_increment(f, rate);
        ASSERT_LE(got > expected ? got - expected : expected - got, (rate & 1) ? 0 : 1)
            << f << "/" << rate;
    }
    EXPECT_EQ(sid_phase_increment(1, 0), 0u);
    EXPECT_EQ(sid_phase_increment(4000, 8000), 0u) << "half the sample rate is refused";
    EXPECT_EQ(sid_phase_increment(2000, 8000), 1ULL << 62);
}

TEST(Osc, SamplesOfPeriodsRoundsToNearest) {
    EXPECT_EQ(sid_samples_of_periods(512, increment_of(30)), 533u);
    EXPECT_EQ(sid_samples_of_periods(2048, increment_of(10)), 6400u);
    EXPECT_EQ(sid_samples_of_periods(256, increment_of(3000)), 3u);
    EXPECT_EQ(sid_samples_of_periods(0xFFFFFFFF, 1), 1u << 30);
    EXPECT_EQ(sid_samples_of_periods(256, 0), 0u);
}

} // namespace
