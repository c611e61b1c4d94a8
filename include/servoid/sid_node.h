/// A drive on a CAN bus: sessions and streamed moves commanded over SDO, telemetry, heartbeats.
///
/// Purpose     Everything between the control interrupt and the CAN controller. The port calls
///             sid_node_step in the interrupt, and in its main loop sid_node_receive for each frame
///             that came and sid_node_poll until it has nothing to send.
/// Frames      SPEC.md, "On the bus": identifiers, objects, telemetry, references.
/// Safety      Guards act here, in the sample that trips them. A master may tighten the limits of
///             the configuration, not widen them. While a run lasts, the master's heartbeat must
///             come: master_timeout after the last one the interrupt itself holds the axis, whether
///             the background still runs or not. A reset, a stop (NMT) or an abort holds it too.
/// Master      One master claims the node before it starts a run; another one's claim is refused
///             until the first releases it or its heartbeat is lost. A run has a number: the same
///             start sent twice starts once.
/// Units       Times in ms in objects, in samples inside. The rest as in sid_excite.h.
/// Overflow    None: counters stop, ticks wrap modulo 2^32 and are compared by difference. No run
///             may last 2^31 samples.
/// Errors      sid_node_init returns false for a configuration out of range. At run time: SDO abort
///             codes, and the reason of the run.
/// Interrupt   sid_node_step: constant-time for each kind of run, no division, no branch on data.
///             The others: background, and not re-entrant. They may be interrupted by
///             sid_node_step.
/// Memory      sizeof(sid_node_t) <= 1024 bytes, owned by the caller, like the rings, the plan and
///             the results.
#ifndef SERVOID_SID_NODE_H
#define SERVOID_SID_NODE_H

#include "servoid/sid_identify.h"
#include "servoid/sid_sdo.h"
#include "servoid/sid_stream.h"
#include "servoid/sid_telemetry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Identifiers; those of a node are plus its number.
#define SID_ID_NMT 0x000U
#define SID_ID_TELEMETRY 0x480U
#define SID_ID_REFERENCES 0x500U
#define SID_ID_ANSWER 0x580U
#define SID_ID_REQUEST 0x600U
#define SID_ID_HEARTBEAT 0x700U

typedef struct {
    sid_axis_t axis;
    sid_identify_config_t identify; ///< guards here are the widest that a master gets; results
                                    ///< needed, plan and plan_length not
    sid_frequency_t* plan;          ///< as many as plan_capacity, and as many results
    uint8_t plan_capacity;          ///< 1..32
    uint8_t node_id;                ///< 1..127
    uint8_t master_id;              ///< whose heartbeat is listened to, 1..127
    uint16_t master_timeout_ms;     ///< 0: a run needs no heartbeat
    uint16_t heartbeat_ms;          ///< of the node's own; 0: none
    sid_row_t* rows;                ///< telemetry ring
    uint32_t row_count;
    int32_t* references; ///< ring of a streamed move
    uint32_t reference_count;
} sid_node_config_t;

/// What the interrupt does. HOLD: the last reference stays while the background prepares a run.
typedef enum { SID_RUN_HOLD = 0, SID_RUN_IDENTIFY, SID_RUN_STREAM } sid_run_kind_t;

typedef struct {
    const sid_node_config_t* config;
    sid_identify_config_t identify; ///< as the master has set it
    sid_identify_t session;
    sid_stream_t stream;
    sid_telemetry_t telemetry;
    sid_run_t run;       ///< the interrupt's from its start on
    sid_run_t next;      ///< handed over with `handover`
    uint32_t owner;      ///< the master's claim; 0: nobody's
    uint32_t run_number; ///< of the last run that was started
    uint32_t run_length; ///< references of the next streamed move
    uint32_t master_timeout;
    volatile uint32_t master_seen; ///< tick of its last heartbeat
    volatile int32_t watched;      ///< -1 while the heartbeat is waited for
    volatile int32_t master_lost;  ///< -1: it did not come
    volatile uint32_t held_tick;   ///< sample in which the axis was held
    volatile int32_t held;         ///< -1: it was
    int32_t reference_q8;          ///< the last one
    volatile uint8_t handover;     ///< the next sample begins this kind of run
    volatile uint8_t kind;         ///< sid_run_kind_t
    uint32_t heartbeat_due;
    uint32_t heartbeat_period;
    uint16_t master_timeout_ms;
    uint16_t heartbeat_ms;
    uint8_t master_id;
    uint8_t planned;    ///< kind of the next run
    uint8_t run_kind;   ///< kind of the last run
    uint8_t state;      ///< sid_state_t
    uint8_t reason;     ///< sid_reason_t of the last run
    uint8_t plan_index; ///< leg that is measured
    uint8_t telemetry_on;
    bool flush;
    bool describe;
    bool progress;
    bool booted;
    bool user_abort;
    bool reset_requested;
} sid_node_t;

SID_STATIC_ASSERT(sizeof(sid_node_t) <= 1024, node_fits_1024_bytes);

/// False if the configuration is out of range. It must outlive the node, as must rings, plan and
/// results.
bool sid_node_init(sid_node_t* node, const sid_node_config_t* config);

/// Once a sample, from the interrupt. The reference is relative to node->run.start_raw, which
/// changes inside this function only; before the first run both are 0 and the drive holds its own
/// position.
void sid_node_step(sid_node_t* node, const sid_sample_t* in, sid_command_t* out);

/// A frame from the bus. True if `answer` is to be sent.
bool sid_node_receive(sid_node_t* node, const sid_can_frame_t* frame, sid_can_frame_t* answer);

/// A portion of the background's work (as sid_identify_poll). True if `frame` is to be sent; then
/// call again.
bool sid_node_poll(sid_node_t* node, uint32_t max_samples, sid_can_frame_t* frame);

/// A run is on.
bool sid_node_is_running(const sid_node_t* node);

/// NMT asked for a reset; the axis is held already. The port resets, or calls sid_node_init again.
bool sid_node_is_reset_requested(const sid_node_t* node);

#ifdef __cplusplus
}
#endif
#endif
