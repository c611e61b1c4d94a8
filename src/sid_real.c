#include "sid_real.h"

#include "servoid/sid_fixed.h"

static int64_t mantissa(sid_real_t a) { return a >> 12; }
static int32_t exponent(sid_real_t a) { return (int32_t)((uint32_t)a << 20) >> 20; }

static uint64_t magnitude(int64_t m) { return (m < 0) ? 0U - (uint64_t)m : (uint64_t)m; }

static sid_real_t pack(uint64_t a, int32_t e, bool negative) {
    if (a == 0U) {
        return SID_REAL_ZERO;
    }
    while (a >= ((uint64_t)1 << 54)) {
        a = (a >> 4) | ((a & 15U) != 0U ? 1U : 0U); // sticky
        e += 4;
    }
    while (a >= ((uint64_t)1 << 51)) {
        a = (a >> 1) + (a & 1U);
        e++;
    }
    while (a < ((uint64_t)1 << 50)) {
        a <<= 1;
        e--;
    }
    const uint64_t word = (negative ? 0U - a : a) << 12;
    return (int64_t)(word | ((uint32_t)sid_clamp(e, -2047, 2047) & 0xFFFU));
}

sid_real_t sid_real_make(int64_t m, int32_t e) { return pack(magnitude(m), e, m < 0); }

sid_real_t sid_real_neg(sid_real_t a) { return sid_real_make(-mantissa(a), exponent(a)); }

sid_real_t sid_real_shift(sid_real_t a, int32_t n) {
    return sid_real_make(mantissa(a), exponent(a) + n);
}

sid_real_t sid_real_mul(sid_real_t a, sid_real_t b) {
    const uint64_t x = magnitude(mantissa(a)) << 11; // < 2^62
    const uint64_t y = magnitude(mantissa(b)) << 11;
    const uint64_t middle = (x >> 32) * (uint32_t)y + (((uint64_t)(uint32_t)x * (uint32_t)y) >> 32);
    const uint64_t other = (uint64_t)(uint32_t)x * (y >> 32) + (uint32_t)middle;
    const uint64_t high = (x >> 32) * (y >> 32) + (middle >> 32) + (other >> 32);
    return pack(high, exponent(a) + exponent(b) + 42, (a < 0) != (b < 0));
}

sid_real_t sid_real_div(sid_real_t a, sid_real_t b) {
    const uint64_t divisor = magnitude(mantissa(b));
    uint64_t rest = 0;
    if (divisor == 0U) {
        return SID_REAL_ZERO;
    }
    // x / y * 2^62 with x < 2 y: through the division of 128 bits.
    const uint64_t quotient =
        sid_divide_128(magnitude(mantissa(a)) >> 2, magnitude(mantissa(a)) << 62, divisor, &rest);
    return pack(quotient, exponent(a) - exponent(b) - 62, (a < 0) != (b < 0));
}

sid_real_t sid_real_add(sid_real_t a, sid_real_t b) {
    if ((a == 0) || ((b != 0) && (exponent(a) < exponent(b)))) {
        const sid_real_t swap = a;
        a = b;
        b = swap;
    }
    if (b == 0) {
        return a;
    }
    const int32_t distance = exponent(a) - exponent(b);
    // Eleven guard bits.
    const int64_t aligned = (distance > 62) ? 0 : ((mantissa(b) * 2048) >> distance);
    return sid_real_make(mantissa(a) * 2048 + aligned, exponent(a) - 11);
}

sid_real_t sid_real_sub(sid_real_t a, sid_real_t b) { return sid_real_add(a, sid_real_neg(b)); }

bool sid_real_less(sid_real_t a, sid_real_t b) { return sid_real_sub(a, b) < 0; }

sid_real_t sid_real_sqrt(sid_real_t a) {
    if (a <= 0) {
        return SID_REAL_ZERO;
    }
    const int32_t odd = exponent(a) & 1;
    uint64_t rest = (uint64_t)mantissa(a) << (10 + odd);
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 62; bit != 0U; bit >>= 2) {
        const uint64_t trial = root + bit;
        root >>= 1;
        if (rest >= trial) {
            rest -= trial;
            root += bit;
        }
    }
    return sid_real_make((int64_t)root, (exponent(a) - odd) / 2 - 5);
}

int64_t sid_real_to_int(sid_real_t a, int32_t n) {
    const int32_t shift = exponent(a) + n;
    if (shift >= 0) {
        return mantissa(a) * ((int64_t)1 << ((shift > 11) ? 11 : shift));
    }
    return (shift < -62) ? 0 : sid_round_shift(mantissa(a), (uint32_t)-shift);
}

void sid_real_store(sid_scaled_t* out, sid_real_t a) {
    int64_t m = sid_round_shift(mantissa(a), 20);
    int32_t e = (a != 0) ? exponent(a) + 20 : 0;
    if ((m > INT32_MAX) || (m < -INT32_MAX)) {
        m /= 2;
        e++;
    }
    out->mantissa = (int32_t)m;
    out->exponent = (int16_t)e;
}

sid_real_t sid_real_from_scaled(sid_scaled_t a) { return sid_real_make(a.mantissa, a.exponent); }

uint64_t sid_divide_128(uint64_t high, uint64_t low, uint64_t divisor, uint64_t* rest) {
    uint64_t quotient = 0;
    uint64_t r = high;
    if (high >= divisor) {
        return UINT64_MAX;
    }
    for (int bit = 63; bit >= 0; bit--) {
        r = (r << 1) | (low >> 63);
        low <<= 1;
        quotient <<= 1;
        if (r >= divisor) {
            r -= divisor;
            quotient |= 1U;
        }
    }
    *rest = r;
    return quotient;
}
