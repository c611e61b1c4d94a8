/// Private: software floating point for the background, in one 64-bit word.
///
/// Formula     value = m * 2^e with m = word >> 12 and e the low 12 bits, both signed; normalised
///             to 2^50 <= |m| < 2^51, or the word 0. Relative rounding 2^-50 per operation.
/// Why         The normal equations of a bin span 40 decades; with this the solver needs no scaling
///             rule. Everything is integer, so the bits are the same on every target; a word
///             travels in two registers of a small core, so the code is a third of what a structure
///             needs.
/// Overflow    |e| clamps at 2047; 2^2000 is beyond any number of this library. x / 0 gives 0.
#ifndef SERVOID_SRC_SID_REAL_H
#define SERVOID_SRC_SID_REAL_H

#include "servoid/sid_scaled.h"

#include <stdbool.h>

typedef int64_t sid_real_t;

#define SID_REAL_ZERO ((sid_real_t)0)

sid_real_t sid_real_make(int64_t m, int32_t e);
sid_real_t sid_real_mul(sid_real_t a, sid_real_t b);
sid_real_t sid_real_div(sid_real_t a, sid_real_t b);
sid_real_t sid_real_add(sid_real_t a, sid_real_t b);
sid_real_t sid_real_sub(sid_real_t a, sid_real_t b);
sid_real_t sid_real_neg(sid_real_t a);
sid_real_t sid_real_shift(sid_real_t a, int32_t n); ///< a * 2^n
sid_real_t sid_real_sqrt(sid_real_t a);             ///< 0 for a <= 0; relative error below 2^-24
bool sid_real_less(sid_real_t a, sid_real_t b);
static inline bool sid_real_is_negative(sid_real_t a) { return a < 0; }
/// round(a * 2^n), for results below 2^62.
int64_t sid_real_to_int(sid_real_t a, int32_t n);

/// By address: a structure of 8 bytes is returned through memory anyway.
void sid_real_store(sid_scaled_t* out, sid_real_t a);
sid_real_t sid_real_from_scaled(sid_scaled_t a);

/// floor((high * 2^64 + low) / divisor), saturated to 2^64 - 1; rest gets the remainder if not
///             saturated.
/// divisor in [1, 2^63].
uint64_t sid_divide_128(uint64_t high, uint64_t low, uint64_t divisor, uint64_t* rest);

#endif
