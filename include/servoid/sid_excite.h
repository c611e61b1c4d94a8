/// The excitation: a sine reference with soft start and stop, and the guards that hold the axis.
///
/// Purpose     Position reference A g sin(p), p = increment * tick, g a linear ramp 0..1;
///             unwrapping of the encoder; four guards that stop the excitation within the very
///             sample that trips them.
/// Formula     r = A g sin p, relative to the position given to sid_excite_rebase.
///             jump    |movement in one sample| > step_limit: the sample is not believed
///             stroke  position outside [-stroke_limit - 1, stroke_limit]
///             torque  torque outside [-torque_limit - 1, torque_limit]
///             stuck   sum of |torque| since the encoder last moved > stuck_limit
///             From a trip on, the reference is the last believed position, and stays there.
/// Units       Session count: encoder count / 2^position_shift, rounded; all positions are in it,
///             relative to the start. Reference Q8 counts, in steps of 1/64, A in [0, 2^22). Torque
///             Q20 of rated torque. Gain Q30.
/// Range       Encoder 1..32 bits, rolling over; |movement| per sample less than half its range.
///             stroke_limit + step_limit <= 2^23 - 1, so a held position always fits Q8 in int32_t.
/// Overflow    Positions wrap modulo 2^32 counts and are never undefined; the tick stops at 2^31 -
///             1, so that a background loop that died cannot start the motion again. Parked, the
///             stuck guard may trip on a torque that rests for long; nothing follows from it.
/// Errors      None in the interrupt. sid_excite_trip tells which guard tripped.
/// Interrupt   sid_excite_step and its inline parts: constant-time. The others: background. Memory
///             contract: the interrupt owns tick, gain, unwrapped, impulse and trip; the background
///             owns the rest and writes it only while tick is parked, except leg_ticks and
///             torque_limit, single words that it may write at any time. tick itself is handed
///             over: parked, it is the background's; storing 0 gives it to the interrupt. Aligned
///             words must be read and written whole, and the interrupt must not be interrupted by
///             the background (SID_FENCE in sid_fixed.h orders the accesses on one core).
/// Memory      sizeof(sid_excite_t) = 72 bytes, owned by the caller.
#ifndef SERVOID_SID_EXCITE_H
#define SERVOID_SID_EXCITE_H

#include "servoid/sid_osc.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the drive measured at this sample.
typedef struct {
    uint32_t position_raw; ///< encoder word, unused upper bits ignored
    int32_t torque_pu_q20; ///< torque, 2^20 = rated
} sid_sample_t;

/// What the drive shall do until the next one.
typedef struct {
    int32_t reference_q8; ///< position reference relative to the start, session counts
    int32_t held;         ///< negative if and only if a guard has tripped
} sid_command_t;

#define SID_TICK_PARKED 0x7FFFFFFFU

typedef struct {
    volatile uint32_t tick; ///< samples since the leg began
    volatile int32_t trip;  ///< negative: tripped; bit 0: by the torque guard
    uint32_t unwrapped;     ///< next to each other: what one load instruction can fetch together
    uint32_t unused_bits;
    uint32_t origin;
    uint32_t position_shift;
    uint32_t impulse;   ///< sum of |torque| since the encoder moved, at least the present |torque|
    int32_t step_limit; ///< encoder counts
    int32_t torque_limit;
    uint32_t stuck_limit;
    int32_t stroke_limit;
    uint32_t leg_ticks; ///< the ramp down begins here by itself
    int32_t gain_step_q30;
    int32_t gain_q30;
    uint64_t increment_q64;
    int32_t amplitude_q9;
} sid_excite_t;

typedef struct {
    uint8_t position_bits;  ///< 1..32
    uint8_t position_shift; ///< 0..8
    int32_t step_limit;     ///< encoder counts per sample, [1, 2^22 * 2^shift]
    int32_t stroke_limit;   ///< session counts, [1, 2^23 - 1 - step_limit / 2^shift]
    int32_t torque_limit;   ///< Q20, [1, 2^23 - 1]
} sid_excite_config_t;

/// One leg: a sine of one frequency.
typedef struct {
    uint64_t increment_q64;
    int32_t amplitude_q8;
    uint32_t ramp_ticks;  ///< 0: at once
    uint32_t leg_ticks;   ///< [1, 2^30], from the first sample to the beginning of the ramp down
    uint32_t stuck_limit; ///< Q20 * samples, [1, 2^30]
} sid_leg_t;

typedef enum {
    SID_TRIP_NONE = 0,
    SID_TRIP_STUCK,
    SID_TRIP_STROKE,
    SID_TRIP_TORQUE,
    SID_TRIP_JUMP
} sid_trip_t;

/// False if a field is out of its range. Until sid_excite_rebase the axis counts as held at
/// position 0.
bool sid_excite_init(sid_excite_t* excite, const sid_excite_config_t* config);
/// Makes position_raw, where the encoder stands now, the zero, and clears a trip. Only while no leg
/// runs.
void sid_excite_rebase(sid_excite_t* excite, uint32_t position_raw);
/// Starts a leg with the next sample. Only while no leg runs. False if the leg is out of range.
bool sid_excite_begin(sid_excite_t* excite, const sid_leg_t* leg);
/// Ramps down from the next sample on.
void sid_excite_finish(sid_excite_t* excite);
/// Ends the leg: the reference is 0, or still the held position after a trip. Only when
/// sid_excite_is_still().
void sid_excite_park(sid_excite_t* excite);
/// Holds the axis where it is, from the next sample on (reported as a trip of the torque guard).
void sid_excite_abort(sid_excite_t* excite);
/// The ramp down is over, or a guard tripped, or no leg has begun.
bool sid_excite_is_still(const sid_excite_t* excite);
/// Which guard tripped; of several in one sample the first of torque, stuck, stroke, jump.
sid_trip_t sid_excite_trip(const sid_excite_t* excite);
/// One sample, for use without a session.
void sid_excite_step(sid_excite_t* excite, const sid_sample_t* in, sid_command_t* out);

/// What the interrupt hands from the guards to the reference and the bin.
typedef struct {
    uint32_t tick;
    int32_t torque; ///< 0 once tripped
    int32_t torque_magnitude;
    int32_t position; ///< frozen once tripped
    int32_t trip;
} sid_tick_t;

/// tick + 1, stopping at 2^31 - 1.
static inline uint32_t sid_tick_next(uint32_t tick) { return (tick + 1U) - ((tick + 1U) >> 31); }

/// Guards, position and tick. What must not be believed (movement in a jump, anything after a trip)
/// is masked away, so that the state freezes at the trip without a branch, and sid_excite_trip()
/// can tell from it what happened.
static inline void sid_excite_guard(sid_excite_t* e, const sid_sample_t* in, sid_tick_t* t) {
    const int32_t before = e->trip;
    const int32_t moved =
        sid_unwrap(e->unwrapped, in->position_raw, e->unused_bits) & ~(before >> 31);
    const int32_t movement = (int32_t)sid_abs(moved);
    const int32_t jump = (int32_t)((uint32_t)e->step_limit - (uint32_t)movement);
    const int32_t moves = (int32_t)(0U - (uint32_t)movement) >> 31;
    e->unwrapped += (uint32_t)(moved & ~(jump >> 31));
    t->position = (int32_t)(e->unwrapped - e->origin) >> e->position_shift;
    t->torque = in->torque_pu_q20 & ~(before >> 31);
    t->torque_magnitude = sid_magnitude(t->torque);
    e->impulse = (e->impulse & ~(uint32_t)moves) + (uint32_t)t->torque_magnitude;
    const int32_t torque = sid_sub_wrap(e->torque_limit, t->torque_magnitude);
    const int32_t stuck = (int32_t)(e->stuck_limit - e->impulse);
    const int32_t stroke = e->stroke_limit - sid_magnitude(t->position);
    t->trip =
        before | ((jump | torque | stuck | stroke) & INT32_MIN) | (int32_t)((uint32_t)torque >> 31);
    e->trip = t->trip;
    t->tick = e->tick;
    e->tick = sid_tick_next(t->tick);
}

/// The ramped sine, or the held position.
static inline int32_t sid_excite_reference(sid_excite_t* e, const sid_tick_t* t, int32_t sine_q31) {
    const int32_t running = (int32_t)(t->tick - e->leg_ticks) >> 31;
    const int32_t gain = sid_clamp(e->gain_q30 + (e->gain_step_q30 ^ running), 0, (1 << 30) - 1);
    e->gain_q30 = gain;
    const int32_t wave_q6 = sid_mulhi(sid_mulhi(sine_q31, gain), e->amplitude_q9);
    return sid_select(t->trip >> 31, sid_shl_wrap(t->position, 8), sid_shl_wrap(wave_q6, 2));
}

#ifdef __cplusplus
}
#endif
#endif
