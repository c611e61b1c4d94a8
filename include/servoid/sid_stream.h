/// Any move: references that come over the bus, played one a sample, with the session's guards.
///
/// Purpose     A session excites with a sine; everything else (a trapezoid, a slow turn, the next
///             experiment) is computed elsewhere and streamed. The background stores frames ahead,
///             the interrupt plays.
/// Frame       CAN FD: kind 1, count n of 1..14, 2 bytes 0, index of the first reference (u32), n
///             references (i32). Only what continues the stored ones without a gap is taken: a
///             repeated frame changes nothing, one after a lost one is refused until the lost one
///             has come again. sid_stream_filled() says from where.
/// Formula     Reference k in sample k of the run; after the last one that stays. A guard that
///             trips (sid_excite.h), or a reference that has not come in time, holds the axis at
///             the measured position in the same sample.
/// Units       Reference Q8 session counts relative to where the axis stood at the start.
/// Overflow    None: references are any int32_t; guards look at the position.
/// Errors      sid_stream_init returns false for guards out of range or a ring that is no power of
///             two of at least 16; sid_stream_prepare for none or more than 2^30 references.
///             sid_excite_trip(&guards) says which guard tripped.
/// Interrupt   sid_stream_step: constant-time. The others: background.
/// Memory      sizeof(sid_stream_t) <= 128 bytes, and 4 bytes a reference of the caller's. The ring
///             must bridge the pauses of the master: 1024 references are 128 ms at 8 kHz.
#ifndef SERVOID_SID_STREAM_H
#define SERVOID_SID_STREAM_H

#include "servoid/sid_can.h"
#include "servoid/sid_excite.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SID_STREAM_REFERENCES 14U ///< in a frame

typedef struct {
    int32_t* references;
    uint32_t mask;
    volatile uint32_t filled; ///< references stored; by the background
    volatile uint32_t played; ///< references handed out; by the interrupt
    volatile uint32_t total;  ///< of the move
    volatile int32_t running; ///< 0 or -1
    int32_t reference_q8;     ///< the last one
    volatile int32_t starved; ///< negative: a reference had not come
    uint32_t refused;         ///< frames that did not continue the stored ones
    sid_excite_t guards;
} sid_stream_t;

SID_STATIC_ASSERT(sizeof(sid_stream_t) <= 128, stream_fits_its_stated_size);

/// A ring of count references, and the guards of every move.
bool sid_stream_init(sid_stream_t* stream, int32_t* references, uint32_t count,
                     const sid_excite_config_t* guards);
/// Forgets the last move and waits for `total` references. Only while none runs.
bool sid_stream_prepare(sid_stream_t* stream, uint32_t total);
/// False if nothing of the frame was new.
bool sid_stream_receive(sid_stream_t* stream, const sid_can_frame_t* frame);
/// Enough is stored: all of the move, or half of the ring.
bool sid_stream_is_ready(const sid_stream_t* stream);
/// Plays from the next sample on; position_raw is where the encoder stands now. stuck_limit: as in
/// sid_leg_t, counted only while the reference moves.
bool sid_stream_start(sid_stream_t* stream, uint32_t position_raw, uint32_t stuck_limit);
/// One sample, from the interrupt.
void sid_stream_step(sid_stream_t* stream, const sid_sample_t* in, sid_command_t* out);
/// Holds the axis from the next sample on (reported as a trip of the torque guard).
void sid_stream_abort(sid_stream_t* stream);
/// All references were played, or the axis is held.
bool sid_stream_is_over(const sid_stream_t* stream);
/// Ends a move that is over, so that the next can be prepared.
void sid_stream_stop(sid_stream_t* stream);

#ifdef __cplusplus
}
#endif
#endif
