/// Friction from runs at constant speed: D, Tc and w.
///
/// Purpose     Least squares of torque on [speed, 1], separately for forward and reverse, from
///             running sums.
/// Formula     T = D v + Tc sgn v + w. Forward x+ = [D+, Tc + w], reverse x- = [D-, -Tc + w]; Tc =
///             (c+ - c-) / 2, D = (D+ + D-) / 2, w = (c+ + c-) / 2: eqs. (8)-(14) of Andoh 2008,
///             doi 10.1109/TPEL.2007.909309.
/// Units       Speed: any unit of the caller's as an integer, [-2^23 + 1, 2^23 - 1]; Q8 counts per
///             sample is a good one. Torque Q20, same range. Results: rated torque, and rated
///             torque per speed unit.
/// Overflow    A speed or torque beyond its range is clamped and counted. With both below 2^23 and
///             at most 65535 samples a direction every sum stays below 2^62; further samples are
///             dropped and counted.
/// Errors      The result starts as SID_FRICTION_NOT_RUN; see sid_friction_status_t. Samples of
///             speed 0 have no direction and are dropped and counted.
/// Interrupt   sid_friction_step may run there: constant-time, no division. sid_friction_solve:
///             background.
/// Memory      sizeof(sid_friction_t) = 104 bytes, owned by the caller.
#ifndef SERVOID_SID_FRICTION_H
#define SERVOID_SID_FRICTION_H

#include "servoid/sid_fixed.h"
#include "servoid/sid_scaled.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SID_FRICTION_COUNT_MAX 65535U

typedef struct {
    int64_t speed;
    int64_t torque;
    int64_t speed_square;
    int64_t torque_square;
    int64_t product;
    uint32_t count;
} sid_friction_sums_t;

typedef struct {
    sid_friction_sums_t side[2]; ///< forward, reverse
    uint32_t clamped;
    uint32_t dropped;
} sid_friction_t;

typedef enum {
    SID_FRICTION_NOT_RUN = 0,
    SID_FRICTION_OK,
    SID_FRICTION_ONE_DIRECTION, ///< Tc and w cannot be told apart
    SID_FRICTION_ONE_SPEED, ///< D and Tc cannot be told apart: spread of speed below a thousandth
                            ///< of its mean
    SID_FRICTION_NEGATIVE   ///< D or Tc came out negative: something else is missing
} sid_friction_status_t;

typedef struct {
    sid_scaled_t viscous;         ///< D
    sid_scaled_t coulomb;         ///< Tc
    sid_scaled_t constant_torque; ///< w
    sid_scaled_t slope[2];        ///< D+, D-
    sid_scaled_t offset[2];       ///< Tc + w, -Tc + w
    sid_scaled_t residual[2];     ///< RMS of torque about the line
    sid_friction_status_t status;
} sid_friction_result_t;

/// Clears the sums.
void sid_friction_init(sid_friction_t* friction);
/// One sample; the sign of the speed says which direction it belongs to.
void sid_friction_step(sid_friction_t* friction, int32_t speed, int32_t torque_pu_q20);
/// Solves from the sums; they stay.
sid_friction_status_t sid_friction_solve(const sid_friction_t* friction,
                                         sid_friction_result_t* out);

#ifdef __cplusplus
}
#endif
#endif
