/// Integer primitives: wrap, saturate, round, select, multiply-high.
///
/// Purpose     Every shift, rounding and saturation of the core goes through here, so that no other
///             file has to think about signed overflow or about the right shift of a negative
///             number.
/// Units       Plain integers; Qn means value = integer / 2^n.
/// Overflow    Functions named *_wrap are modulo 2^32 and never undefined. sid_saturate_* clamp.
///             sid_mul_shift states its range. Nothing here traps.
/// Interrupt   All are constant-time: selections are masks or minimum/maximum, never a branch on
///             data.
/// Memory      None.
///
/// Two properties of the compiler are assumed and checked here at compile time: the right shift of
/// a negative number is arithmetic, and unsigned-to-signed conversion is modulo 2^32. GCC, Clang,
/// IAR and Arm Compiler have both.
#ifndef SERVOID_SID_FIXED_H
#define SERVOID_SID_FIXED_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Compile-time assertion that C99 and C++ both accept.
#define SID_STATIC_ASSERT(condition, name) typedef char sid_assert_##name[(condition) ? 1 : -1]

SID_STATIC_ASSERT((-5 >> 1) == -3, right_shift_is_arithmetic);
SID_STATIC_ASSERT((int32_t)0xFFFFFFFFU == -1, conversion_is_modulo);
SID_STATIC_ASSERT((int64_t)-1 >> 63 == -1, right_shift_of_64_bit_is_arithmetic);

/// Order of memory accesses between the interrupt and the background loop of ONE core. Define it
/// before including this file (for instance as a data memory barrier) if the two run on different
/// cores.
#ifndef SID_FENCE
#if defined(__GNUC__)
#define SID_FENCE() __atomic_signal_fence(__ATOMIC_SEQ_CST)
#else
#define SID_FENCE() ((void)0)
#endif
#endif

/// A function that is called and not copied where size counts (-Os), though the compiler thinks
/// that copies are smaller.
#if defined(__GNUC__) && defined(__OPTIMIZE_SIZE__)
#define SID_ONCE __attribute__((noinline))
#else
#define SID_ONCE
#endif

/// a + b, a - b modulo 2^32.
static inline int32_t sid_add_wrap(int32_t a, int32_t b) {
    return (int32_t)((uint32_t)a + (uint32_t)b);
}
static inline int32_t sid_sub_wrap(int32_t a, int32_t b) {
    return (int32_t)((uint32_t)a - (uint32_t)b);
}

/// a * 2^n modulo 2^32, n in [0, 31].
static inline int32_t sid_shl_wrap(int32_t a, uint32_t n) { return (int32_t)((uint32_t)a << n); }

/// floor(a * b / 2^32): Qm times Qn gives Q(m + n - 32). Any operands.
static inline int32_t sid_mulhi(int32_t a, int32_t b) {
    return (int32_t)(((int64_t)a * (int64_t)b) >> 32);
}

/// |a| modulo 2^32; the most negative number gives 2^31.
static inline uint32_t sid_abs(int32_t a) {
    const uint32_t m = (uint32_t)(a >> 31);
    return ((uint32_t)a ^ m) - m;
}

/// |a| for a >= 0 and |a| - 1 for a < 0: one operation less than |a|, never negative, for symmetric
/// limits.
static inline int32_t sid_magnitude(int32_t a) { return a ^ (a >> 31); }

/// mask ? a : b, with mask 0 or -1.
static inline int32_t sid_select(int32_t mask, int32_t a, int32_t b) {
    return b ^ ((a ^ b) & mask);
}

/// -1 if x is not 0, else 0.
static inline int32_t sid_nonzero(uint32_t x) { return (int32_t)(x | (0U - x)) >> 31; }

/// Sign bit set if and only if |x| > limit, for limit in [0, 2^30]; the other bits mean nothing.
static inline int32_t sid_beyond(int32_t x, int32_t limit) {
    return sid_add_wrap(limit, x) | sid_sub_wrap(limit, x);
}

/// x clamped to [low, high].
static inline int32_t sid_clamp(int32_t x, int32_t low, int32_t high) {
    const int32_t y = (x < low) ? low : x;
    return (y > high) ? high : y;
}
static inline int64_t sid_clamp64(int64_t x, int64_t low, int64_t high) {
    const int64_t y = (x < low) ? low : x;
    return (y > high) ? high : y;
}

/// x clamped to the range of int32_t.
static inline int32_t sid_saturate(int64_t x) {
    return (int32_t)sid_clamp64(x, INT32_MIN, INT32_MAX);
}

/// x / 2^n rounded to nearest, halves up; n in [0, 62], |x| + 2^(n-1) < 2^63.
static inline int64_t sid_round_shift(int64_t x, uint32_t n) {
    return (x + (((int64_t)1 << n) >> 1)) >> n;
}

/// s * m / 2^n rounded to nearest, halves up; n in [33, 94], any s and m. The 95-bit product is
///             never formed: the low
/// word of s contributes through its upper half only, which rounding cannot see (n > 32).
static inline int64_t sid_mul_shift(int64_t s, int32_t m, uint32_t n) {
    const int64_t high = (int64_t)(int32_t)(s >> 32) * m;
    const int64_t low = (int64_t)(uint32_t)s * m;
    return (high + (low >> 32) + ((int64_t)1 << (n - 33U))) >> (n - 32U);
}

/// A monotonic counter that stops at 2^31 instead of wrapping; bit is 0 or 1.
static inline uint32_t sid_count(uint32_t counter, uint32_t bit) {
    return counter + (bit & ~(counter >> 31));
}

/// Movement from an unwrapped position to a raw encoder word of 32 - unused bits (unused in [0,
/// 31]), by the shorter way round. Correct if and only if the axis moved less than half the
/// encoder's range since then.
static inline int32_t sid_unwrap(uint32_t unwrapped, uint32_t raw, uint32_t unused) {
    return (int32_t)((raw - unwrapped) << unused) >> unused;
}

#ifdef __cplusplus
}
#endif
#endif
