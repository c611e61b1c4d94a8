/// Telemetry at the control rate: every sample of the interrupt, five to a CAN FD frame.
///
/// Purpose     The interrupt pushes one row a sample into a ring of the caller's; the background
///             packs rows into frames. 8 kHz are 1600 frames of 64 bytes a second, a quarter of a
///             bus of 1 / 5 Mbit/s; classic CAN cannot carry it.
/// Frames      SPEC.md, "Telemetry": samples (64 bytes), description (48), progress (12).
/// Units       Encoder word, Q8 session counts of the reference, Q20 of rated torque. A row's tick
///             is the number of rows pushed before it, modulo 2^32.
/// Overflow    Torque is clamped to 24 bits, +-8 times rated. If the background falls behind by
///             more than the ring, the oldest rows are lost: `lost` counts them, and the ticks of
///             the frames jump.
/// Errors      sid_telemetry_init returns false unless count is a power of two of at least 16.
/// Interrupt   sid_telemetry_push: constant-time, 4 stores. The others: background. One writer,
///             one reader, no lock.
/// Memory      sizeof(sid_telemetry_t) <= 32 bytes, and 12 bytes a row of the caller's.
#ifndef SERVOID_SID_TELEMETRY_H
#define SERVOID_SID_TELEMETRY_H

#include "servoid/sid_can.h"
#include "servoid/sid_excite.h"
#include "servoid/sid_inertia.h"

#ifdef __cplusplus
extern "C" {
#endif

/// First byte of a telemetry frame.
#define SID_FRAME_SAMPLES 1U
#define SID_FRAME_DESCRIPTION 2U
#define SID_FRAME_PROGRESS 3U

#define SID_TELEMETRY_ROWS 5U ///< in a frame of samples
#define SID_TELEMETRY_VERSION 1U

typedef struct {
    uint32_t position_raw;
    int32_t reference_q8;
    int32_t torque_pu_q20;
} sid_row_t;

typedef struct {
    sid_row_t* rows;
    uint32_t mask;
    volatile uint32_t written; ///< by the interrupt only: the tick
    uint32_t read;
    uint32_t lost;
    uint16_t sequence;
} sid_telemetry_t;

SID_STATIC_ASSERT(sizeof(sid_telemetry_t) <= 32, telemetry_fits_its_stated_size);

/// What the integers of this drive mean; constant while it is powered.
typedef struct {
    uint64_t sample_rate_uHz;
    sid_scaled_t rated_torque;    ///< N m, or N of a linear axis
    sid_scaled_t count;           ///< rad or m of an encoder count
    uint32_t encoder_increments;  ///< object 0x608F:1
    uint32_t encoder_revolutions; ///< object 0x608F:2
    bool linear;
} sid_axis_t;

/// What belongs to one run.
typedef struct {
    uint32_t start_tick; ///< row at which it began; 0: none has yet
    uint32_t end_tick;   ///< row at which it was seen to be over; 0: it is not
    uint32_t start_raw;  ///< encoder word there: the reference's zero
    uint8_t position_bits;
    uint8_t position_shift;
    uint8_t torque_timing; ///< sid_torque_timing_t
} sid_run_t;

/// A ring of count rows, tick 0.
bool sid_telemetry_init(sid_telemetry_t* telemetry, sid_row_t* rows, uint32_t count);

/// Once a sample, from the interrupt.
static inline void sid_telemetry_push(sid_telemetry_t* t, const sid_sample_t* in,
                                      int32_t reference_q8) {
    const uint32_t tick = t->written;
    sid_row_t* const row = &t->rows[tick & t->mask];
    row->position_raw = in->position_raw;
    row->reference_q8 = reference_q8;
    row->torque_pu_q20 = in->torque_pu_q20;
    SID_FENCE();
    t->written = tick + 1U;
}

/// Frames begin with the next row; what is in the ring is passed over and not lost.
void sid_telemetry_skip(sid_telemetry_t* telemetry);

/// The next five rows; with `flush`, what there is. False if there are not so many. state:
/// sid_state_t, as of now.
bool sid_telemetry_pack(sid_telemetry_t* telemetry, uint8_t state, bool flush,
                        sid_can_frame_t* frame);

/// The frame that makes a log complete in itself.
void sid_telemetry_describe(sid_telemetry_t* telemetry, const sid_axis_t* axis,
                            const sid_run_t* run, sid_can_frame_t* frame);

/// How far a streamed move has come: references received without a gap, and handed out.
void sid_telemetry_progress(sid_telemetry_t* telemetry, uint8_t state, uint32_t filled,
                            uint32_t played, sid_can_frame_t* frame);

#ifdef __cplusplus
}
#endif
#endif
