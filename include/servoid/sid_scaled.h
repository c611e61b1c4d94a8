/// Numbers of any magnitude for results and gains: mantissa and exponent, no floating point.
///
/// Purpose     An inertia in drive units may be 1e-9 or 1e+6; one Q format cannot hold both.
/// Formula     value = mantissa * 2^exponent. Normalised: 2^30 <= |mantissa| < 2^31, or zero (0,
///             0).
/// Range       2^-2000 to 2^2000; relative rounding 2^-31 per operation.
/// Overflow    Exponents clamp beyond that range; no operation is undefined. x / 0 gives 0.
/// Interrupt   No: background only (loops over bits).
/// Memory      8 bytes a number.
///
/// On a host: double x = ldexp(s.mantissa, s.exponent).
#ifndef SERVOID_SID_SCALED_H
#define SERVOID_SID_SCALED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int32_t mantissa;
    int16_t exponent;
} sid_scaled_t;

/// mantissa * 2^exponent, normalised and rounded.
sid_scaled_t sid_scaled_make(int64_t mantissa, int32_t exponent);
/// a * b.
sid_scaled_t sid_scaled_mul(sid_scaled_t a, sid_scaled_t b);
/// a / b; 0 where b is 0.
sid_scaled_t sid_scaled_div(sid_scaled_t a, sid_scaled_t b);
/// round(value * 2^fraction_bits), saturated to int32_t.
int32_t sid_scaled_to_fixed(sid_scaled_t a, int32_t fraction_bits);

#ifdef __cplusplus
}
#endif
#endif
