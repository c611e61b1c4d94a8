/// The position-P speed-PI loop, for drives without one, for tests and for the simulated drive.
///
/// Formula     e = Kp (r - theta) - speed, T = Kvj (e + (1/Ti) sum(e) h): eq. (16) of Andoh 2008,
///             doi 10.1109/TPEL.2007.909309. The sum includes the present sample. The speed is the
///             backward difference of position, averaged over speed_average samples: (theta[k] -
///             theta[k - n]) / n.
/// Units       Position counts relative to the start, reference Q8 counts, torque Q20 of rated.
///             Gains per sample: position_gain Kp h [1], speed_gain in rated torque per (count /
///             sample), integral_gain h / Ti [1] (0: no integrator, P-P control).
/// Range       |r|, |theta| < 2^23 counts. position_gain (0, 1]; speed_gain [2^-50, 2^9];
///             integral_gain [0, 1]. Covers 10 to 24 bits a turn, linear axes from nanometres a
///             count, 1 ms to 10 us.
/// Precision   e and its sum are Q32 in 64 bits and all results are rounded, not truncated: the
///             torque is within 1 LSB of Q20 of the same loop in exact arithmetic.
/// Overflow    The torque is clamped to the limit and saturated_samples moves; while it is clamped
///             the sum takes only what leads back. Reference minus position is clamped to 2^23
///             counts, the movement to 2^24, so |e| < 2^57; the sum is held where it alone would
///             give twice the limit, at most 2^60: nothing overflows.
/// Errors      sid_loop_init returns false for a configuration out of range.
/// Interrupt   sid_loop_step: constant-time, no division. The others: background.
/// Memory      sizeof(sid_loop_t) = 80 bytes, owned by the caller.
#ifndef SERVOID_SID_LOOP_H
#define SERVOID_SID_LOOP_H

#include "servoid/sid_fixed.h"
#include "servoid/sid_scaled.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    sid_scaled_t position_gain;
    sid_scaled_t speed_gain;
    sid_scaled_t integral_gain;
    int32_t torque_limit_pu_q20; ///< [1, 2^23 - 1]
    uint8_t speed_average;       ///< 1..4; 0: 1
} sid_loop_config_t;

typedef struct {
    int64_t sum_q32;
    int64_t demand_limit_q32;     ///< demand that surely saturates
    int64_t speed_reciprocal_q32; ///< 2^32 / n
    int32_t position_gain;        ///< mantissas and their shifts
    int32_t speed_gain;
    int32_t integral_gain;
    uint32_t position_shift;
    uint32_t speed_shift;
    uint32_t integral_shift;
    int32_t torque_limit;
    int32_t past[4];
    uint32_t saturated_samples;
    uint8_t speed_average;
} sid_loop_t;

/// Takes over the gains and stands at position 0. False if one is out of range.
bool sid_loop_init(sid_loop_t* loop, const sid_loop_config_t* config);
/// Forgets the sum and takes position as where the axis has been standing.
void sid_loop_reset(sid_loop_t* loop, int32_t position_count);
/// One sample; returns the torque, Q20 of rated.
int32_t sid_loop_step(sid_loop_t* loop, int32_t reference_q8, int32_t position_count);

#ifdef __cplusplus
}
#endif
#endif
