/// The session: excites, measures and evaluates a plan of frequencies; the drive calls step and
/// poll.
///
/// Purpose     sid_identify_step from the drive's interrupt, once a sample; sid_identify_poll from
///             its background loop.
/// Formula     Leg of one frequency: ramp up, settle, window (gap, window ...), ramp down, rest;
///             all counted in samples from the leg's first one. Window n of N samples begins at
///             ramp + settle + n (N + gap). The ramp down begins by itself after the last window,
///             whether the background still runs or not.
/// Units       As in sid_excite.h (session counts, Q8 reference, Q20 torque) and sid_inertia.h
///             (results).
/// Overflow    The guards keep the samples that reach the sums within the range of the bin. The one
///             sample at which a guard trips may be anything: it cannot overflow the sums either,
///             and they are not used.
/// Errors      sid_identify_init and sid_identify_start return false for a configuration that is
///             out of range. At run time nothing stops the interrupt: a guard holds the axis at the
///             measured position in the same sample, poll then ends the session with the reason,
///             and the counter of that fault moves. A window that cannot be used gives its
///             frequency a reason other than SID_OK and the plan goes on, unless the torque was at
///             its limit for a quarter of the window: that ends the session too.
/// Interrupt   sid_identify_step: constant-time, no division, no branch on data. All other
///             functions: background.
/// Memory      sizeof(sid_identify_t) <= 512 bytes, owned by the caller; configuration, plan and
///             results are the caller's too and must outlive the session. About 1 KiB of
///             background stack while solving.
/// Contract    One core: the interrupt may preempt the background, not the reverse; aligned 32-bit
///             words are read and written whole. The word excite.tick decides who owns the session
///             (see sid_excite.h); while a leg runs, the interrupt owns the sums inside the window
///             and the background outside it. Before it writes window_start, which hands the sums
///             to the interrupt, the background has finished with them.
#ifndef SERVOID_SID_IDENTIFY_H
#define SERVOID_SID_IDENTIFY_H

#include "servoid/sid_excite.h"
#include "servoid/sid_inertia.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint64_t increment_q64; ///< sid_phase_increment()
    int32_t amplitude_q8;   ///< of the position reference, session counts, [0, 2^30)
} sid_frequency_t;

/// Zero means the default in brackets, except where a value is needed.
typedef struct {
    const sid_frequency_t* plan; ///< needed
    sid_result_t* results;       ///< needed: as many as the plan is long
    uint8_t plan_length;         ///< needed: 1..255
    uint8_t windows;             ///< per frequency, 1..8 [1]
    uint8_t position_bits;       ///< of the encoder word, 1..32 [32]
    /// What sine and trend may leave of a window's position, RMS, over its amplitude, a count
    /// aside; 255: anything [21: 8 %]
    uint8_t distortion_q8;
    uint8_t position_shift;     ///< 0..8: encoder bits dropped to make a session count [0]
    uint16_t ramp_periods_q8;   ///< [0: the sine starts at once]
    uint16_t settle_periods_q8; ///< between ramp and first window [2048: 8 periods]
    uint16_t window_periods_q8; ///< [512: 2 periods]
    uint16_t gap_periods_q8;    ///< between windows: the background's time to solve [256: 1 period]
    uint32_t rest_samples;      ///< after a leg, at rest [0]
    int32_t torque_limit_pu_q20;      ///< guard [2^23 - 1: 8 times rated]
    int32_t torque_saturation_pu_q20; ///< |torque| from here on counts as saturated [none]
    int32_t stroke_limit_count;       ///< guard, session counts from the start [the widest allowed]
    int32_t step_limit_count; ///< guard, encoder counts per sample [an eighth of the range, at most
                              ///< 2^22]
    uint32_t
        stuck_limit_pu_q20; ///< guard, sum of |torque| without motion [rated / 4 over one period]
    int32_t torque_min_pu_q20;         ///< amplitude [2^10]
    int32_t position_min_q8;           ///< amplitude, session counts [2 counts]
    sid_bin_method_t method;           ///< [SID_BIN_CUBIC]
    sid_torque_timing_t torque_timing; ///< [SID_TORQUE_SAMPLED]
} sid_identify_config_t;

typedef enum {
    SID_STATE_IDLE = 0,
    SID_STATE_MEASURING,
    SID_STATE_STOPPING,
    SID_STATE_DONE,   ///< every frequency of the plan has a reason; reference 0
    SID_STATE_ABORTED ///< the reference holds the axis; sid_identify_reason() says why
} sid_state_t;

/// Monotonic since sid_identify_init; each stops at 2^31.
typedef struct {
    uint32_t torque_saturated_samples; ///< inside windows
    uint32_t torque_aborts;
    uint32_t stroke_aborts;
    uint32_t encoder_jumps;
    uint32_t encoder_stuck;
    uint32_t user_aborts;
    uint32_t missed_polls; ///< windows that were lost because poll came too late
} sid_counters_t;

typedef struct {
    sid_excite_t excite;
    sid_bin_t bin;
    uint32_t window_start;
    uint32_t window_count;
    uint32_t saturated;       ///< samples of this window
    int32_t saturation_below; ///< largest |torque| that is not saturated
    uint32_t first_window;
    uint32_t window_pitch;
    uint32_t leg_over;
    const sid_identify_config_t* config;
    sid_counters_t counters;
    uint8_t plan_index;
    uint8_t window_index;
    uint8_t state;  ///< sid_state_t
    uint8_t reason; ///< sid_reason_t of the session
    bool abort_requested;
    bool give_up; ///< end the session after this leg
} sid_identify_t;

SID_STATIC_ASSERT(sizeof(sid_identify_t) <= 512, session_fits_512_bytes);

/// The guards that a configuration asks for, with the defaults filled in.
sid_excite_config_t sid_identify_guards(const sid_identify_config_t* config);

/// Checks the configuration, marks every result SID_NOT_RUN. The axis counts as held.
bool sid_identify_init(sid_identify_t* session, const sid_identify_config_t* config);

/// Begins the plan with the next step; position_raw is where the encoder stands now and becomes the
/// reference's zero. False while a session runs, or if a frequency of the plan is out of range (a
/// window beyond 65535 samples, say).
bool sid_identify_start(sid_identify_t* session, uint32_t position_raw);

/// Once a sample, from the interrupt.
void sid_identify_step(sid_identify_t* session, const sid_sample_t* in, sid_command_t* out);

/// As often as convenient, from the background; does at most max_samples of replay and one
///             solution.
sid_state_t sid_identify_poll(sid_identify_t* session, uint32_t max_samples);

/// Holds the axis from the next sample on and ends the session at the next poll.
void sid_identify_abort(sid_identify_t* session);

/// SID_NOT_RUN until the session ended; SID_OK if every frequency is; else the first other reason.
sid_reason_t sid_identify_reason(const sid_identify_t* session);

#ifdef __cplusplus
}
#endif
#endif
