#include "support.hpp"

#include <gtest/gtest.h>

namespace {

const int32_t kEdges[] = {
    INT32_MIN, INT32_MIN + 1, -8388608, -65536,  -257,          -2,       -1, 0, 1, 2,
    255,       65535,         8388607,  1 << 30, INT32_MAX - 1, INT32_MAX};

int64_t half_up(__int128 x, unsigned n) { return int64_t((x + (__int128(1) << n >> 1)) >> n); }

TEST(Fixed, MulhiIsTheUpperWord) {
    for (int32_t a : kEdges)
        for (int32_t b : kEdges)
            ASSERT_EQ(sid_mulhi(a, b), int32_t((__int128(a) * b) >> 32));
}

TEST(Fixed, RoundShiftRoundsHalvesUp) {
    std::mt19937_64 random(seed_of("round"));
    for (int i = 0; i < 100000; i++) {
        const unsigned n = unsigned(random() % 63);
        const int64_t x = int64_t(random()) >> (1 + random() % 40);
        ASSERT_EQ(sid_round_shift(x, n), half_up(x, n)) << x << " " << n;
    }
}

TEST(Fixed, MulShiftIsExactAtTheExtremes) {
    std::mt19937_64 random(seed_of("mul_shift"));
    const int64_t big[] = {INT64_MIN, INT64_MIN + 1, -1, 0, 1, INT64_MAX, INT64_MAX - 1};
    for (int64_t s : big)
        for (int32_t m : kEdges)
            for (unsigned n = 33; n <= 94; n++)
                ASSERT_EQ(sid_mul_shift(s, m, n), half_up(__int128(s) * m, n))
                    << s << " " << m << " " << n;
    for (int i = 0; i < 100000; i++) {
        const int64_t s = int64_t(random()) >> (random() % 50);
        const int32_t m = int32_t(uint32_t(random()));
        const unsigned n = 33 + unsigned(random() % 62);
        ASSERT_EQ(sid_mul_shift(s, m, n), half_up(__int128(s) * m, n));
    }
}

TEST(Fixed, SelectClampAbsAndSaturate) {
    for (int32_t a : kEdges)
        for (int32_t b : kEdges) {
            EXPECT_EQ(sid_select(-1, a, b), a);
            EXPECT_EQ(sid_select(0, a, b), b);
            EXPECT_EQ(sid_add_wrap(a, b), int32_t(uint32_t(a) + uint32_t(b)));
            EXPECT_EQ(sid_saturate(int64_t(a) + b),
                      int32_t(std::min<int64_t>(INT32_MAX,
                                                std::max<int64_t>(INT32_MIN, int64_t(a) + b))));
            const bool beyond = std::llabs(int64_t(a)) > std::abs(b >> 2);
            if (b >= 0) {
                EXPECT_EQ(sid_beyond(a, b >> 2) < 0, beyond) << a << " " << (b >> 2);
            }
        }
    for (int32_t a : kEdges) {
        EXPECT_EQ(sid_abs(a), uint32_t(std::llabs(int64_t(a))));
        EXPECT_EQ(sid_magnitude(a), a < 0 ? -(a + 1) : a);
    }
}

TEST(Fixed, CounterStopsAtTwoToThe31) {
    EXPECT_EQ(sid_count(0, 1), 1u);
    EXPECT_EQ(sid_count(0x7FFFFFFF, 1), 0x80000000u);
    EXPECT_EQ(sid_count(0x80000000, 1), 0x80000000u);
    EXPECT_EQ(sid_tick_next(0x7FFFFFFF), 0x7FFFFFFFu);
    EXPECT_EQ(sid_tick_next(5), 6u);
}

TEST(Fixed, UnwrapFollowsRollOverAtEveryWidth) {
    std::mt19937_64 random(seed_of("unwrap"));
    for (unsigned bits = 2; bits <= 32; bits++) {
        const uint32_t mask = uint32_t((1ULL << bits) - 1);
        const int64_t most = (1LL << (bits - 1)) - 1;
        int64_t position = 0;
        uint32_t unwrapped = 0;
        for (int i = 0; i < 2000; i++) {
            const int64_t step = int64_t(random() % uint64_t(2 * most + 1)) - most;
            position += step;
            const uint32_t noise = uint32_t(random()) & ~mask; // unused upper bits
            ASSERT_EQ(sid_unwrap(unwrapped, (uint32_t(position) & mask) | noise, 32 - bits), step)
                << bits;
            unwrapped += uint32_t(step);
        }
    }
}

} // namespace
