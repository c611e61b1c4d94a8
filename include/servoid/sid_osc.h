/// The oscillator: sine and cosine of a 64-bit phase, and phase increments.
///
/// Purpose     One phase for excitation and demodulation.
/// Formula     Phase in turns as Q64 (one turn = 2^64, wraps naturally). The phase of sample k is
///             increment * k: it is computed, not accumulated, so that nothing drifts and any
///             sample can be recomputed. 128 table entries a turn and the Taylor series of the
///             remaining |d| <= pi/128: sin(i + d) = S + C sin d - S (1 - cos d), cos(i + d) = C -
///             S sin d - C (1 - cos d).
/// Units       Sine and cosine Q31, [-2^31 + 1, 2^31 - 1].
/// Error       At most 2 LSB of Q31 at every phase, however many samples have passed: 0.5 table,
///             0.5 final rounding, 0.2 Taylor remainder d^5/120, 0.5 truncations with 2 guard bits.
/// Overflow    None: the correction never points away from zero at a peak, where |S| = 2^31 - 1.
/// Interrupt   sid_osc is constant-time, about 33 instructions on a Cortex-M4; the other functions
///             divide bit by bit and belong in the background.
/// Memory      640 bytes of constants, no state.
#ifndef SERVOID_SID_OSC_H
#define SERVOID_SID_OSC_H

#include "servoid/sid_fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/// sin(2 pi i / 128) in Q31 for i = 0..159, then two constants of the series
/// (src/make_osc_table.py).
extern const int32_t sid_osc_table[160 + 2];

typedef struct {
    int32_t sine_q31;
    int32_t cosine_q31;
} sid_osc_t;

/// Sine and cosine of a phase.
static inline sid_osc_t sid_osc(uint64_t phase_q64) {
    const uint64_t shifted = phase_q64 + ((uint64_t)1 << 56);
    const int32_t* const entry = &sid_osc_table[(uint32_t)(shifted >> 57)];
    const int32_t s = entry[0];
    const int32_t c = entry[32];
    // The distance to the entry: 2^-39 turn, then Q34 rad.
    const int32_t turn = (int32_t)((uint32_t)(shifted >> 25) ^ 0x80000000U);
    const int32_t d = sid_mulhi(turn, sid_osc_table[160]);
    const int32_t square_q36 = sid_mulhi(d, d);
    const int32_t sixth_q32 = sid_mulhi(square_q36, sid_osc_table[161]);
    const int32_t sin_q34 = d - sid_mulhi(d, sixth_q32);
    const int32_t versine_q34 = sid_mulhi(square_q36, (sixth_q32 >> 4) - (1 << 29));
    const int32_t ds = (int32_t)(((int64_t)c * sin_q34 + (int64_t)s * versine_q34) >> 32);
    const int32_t dc = (int32_t)(((int64_t)c * versine_q34 + (int64_t)s * -sin_q34) >> 32);
    sid_osc_t out;
    out.sine_q31 = s + ((ds + 2) >> 2);
    out.cosine_q31 = c + ((dc + 2) >> 2);
    return out;
}

/// The same as a function, where size counts more than a call.
sid_osc_t sid_osc_at(uint64_t phase_q64);

/// round(2^64 * frequency / sample_rate): turns per sample, exact to half an LSB of Q64. Both in
/// the same unit, for instance microhertz. Returns 0, which is never a valid increment, if and only
/// if sample_rate is 0 or above 2^63, or frequency is not below half of it, or the quotient rounds
/// to 0.
uint64_t sid_phase_increment(uint64_t frequency, uint64_t sample_rate);

/// round(periods * samples per period), periods in Q8; saturates at 2^30. 0 if increment is 0.
uint32_t sid_samples_of_periods(uint32_t periods_q8, uint64_t increment_q64);

#ifdef __cplusplus
}
#endif
#endif
