/// Inertia and viscous friction from the fundamentals of torque and position.
///
/// Formula     With T and H the phasors of torque and position (y = a cos p + b sin p is Y = a -
///             jb) and w the angular frequency: J = -Re(T H*) / (w^2 |H|^2), D = Im(T H*) / (w
///             |H|^2). With pure sines this is eq. (5), J = -2 mean(T theta) / (w^2 A^2), of Andoh
///             2008, doi 10.1109/TPEL.2007.909309.
/// Timing      A torque that is held over a sample period acts half a period later than it is set.
///             torque_timing turns T by the known time and divides by the hold's sin(w/2)/(w/2).
/// Units       Per sample: J in rated torque per (count / sample^2), D in rated torque per (count /
///             sample), count as the bin saw it. With rated torque T_r, count angle c and sample
///             time h: J * T_r * h^2 / c in kg m^2, D * T_r * h / c in N m s. Amplitudes: rated
///             torque, counts.
/// Accuracy    The arithmetic adds a relative error below 1e-8 to what the sums hold.
/// Errors      The result starts as SID_NOT_RUN, and inertia, viscous and their deviations are 0
///             unless reason is SID_OK. J <= 0 is SID_NEGATIVE_INERTIA, never an answer.
/// Interrupt   No: background.
/// Memory      sizeof(sid_result_t) = 88 bytes, owned by the caller; about 1 KiB of stack while
///             solving.
#ifndef SERVOID_SID_INERTIA_H
#define SERVOID_SID_INERTIA_H

#include "servoid/sid_bin.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    SID_NOT_RUN = 0,
    SID_OK,
    SID_NO_EXCITATION,    ///< torque or position amplitude below the minimum
    SID_SATURATED,        ///< torque at its limit during the window
    SID_WINDOW_TOO_SHORT, ///< less than one period, or too few samples
    SID_STROKE_CLIPPED,   ///< position beyond the range of the bin
    SID_OVERFLOW,         ///< torque beyond the range of the bin
    SID_ILL_CONDITIONED,  ///< trend and sine cannot be told apart in this window
    SID_NEGATIVE_INERTIA,
    SID_NOT_A_SINE, ///< the position is none (sid_identify.h): the axis sticks, samples are missing
    SID_ABORTED_STROKE,
    SID_ABORTED_TORQUE,
    SID_ABORTED_BY_USER,
    SID_ENCODER_STUCK,
    SID_ENCODER_JUMP,
    SID_MASTER_LOST,    ///< no heartbeat of the master within its time (sid_node.h)
    SID_STREAM_STARVED, ///< a streamed reference had not come in time (sid_stream.h)
    SID_REASON_COUNT
} sid_reason_t;

/// A short English text, for every value; "unknown" outside the enumeration.
const char* sid_reason_text(sid_reason_t reason);

typedef enum {
    SID_TORQUE_SAMPLED = 0, ///< plain samples: torque and position of the same instant
    SID_TORQUE_HELD_NEXT,   ///< set at this sample, held until the next
    SID_TORQUE_HELD_LAST    ///< set one sample ago, held until this one
} sid_torque_timing_t;

typedef struct {
    sid_bin_method_t method;
    sid_torque_timing_t torque_timing;
    int32_t torque_min_pu_q20;  ///< amplitude; 0: 2^10, a thousandth of rated
    int32_t position_min_q8;    ///< amplitude; 0: 2 counts
    uint32_t saturated_samples; ///< of this window; any makes the result SID_SATURATED
} sid_inertia_config_t;

typedef struct {
    sid_scaled_t inertia;
    sid_scaled_t
        inertia_std; ///< of the mean over windows; 0 and std_known false for a single window
    sid_scaled_t viscous;
    sid_scaled_t viscous_std;
    sid_scaled_t torque_amplitude;
    sid_scaled_t position_amplitude;
    sid_scaled_t torque_residual; ///< RMS of what sine and trend leave
    sid_scaled_t position_residual;
    sid_scaled_t smallest_pivot; ///< 1: well conditioned, 0: not at all
    uint64_t increment_q64;
    uint8_t reason; ///< sid_reason_t
    uint8_t windows;
    bool std_known;
} sid_result_t;

/// Evaluates one window. Returns the reason, which is also in the result.
sid_reason_t sid_inertia_solve(const sid_bin_t* bin, const sid_inertia_config_t* config,
                               sid_result_t* result);

/// Adds window to the mean that result holds over result->windows earlier ones (0 for none). Both
///             with reason SID_OK.
void sid_inertia_combine(sid_result_t* result, const sid_result_t* window);

/// Turns the sums of squares that sid_inertia_combine keeps in the *_std fields into deviations of
/// the mean.
void sid_inertia_finish(sid_result_t* result);

#ifdef __cplusplus
}
#endif
#endif
