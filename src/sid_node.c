#include "servoid/sid_node.h"

#include "sid_node_objects.h"

#include <string.h>

#define NMT_STOP 0x02U
#define NMT_RESET_NODE 0x81U
#define NMT_RESET_COMMUNICATION 0x82U
#define BOOTED_UP 0x00U
#define OPERATIONAL 0x05U
// Frames of samples from one description to the next: a log that begins late is soon complete.
#define DESCRIBE_EVERY 1024U

// ---------------------------------------------------------------- configuration

static uint32_t ticks_of_ms(const sid_node_t* node, uint32_t ms) {
    return (uint32_t)(ms * node->config->axis.sample_rate_uHz / 1000000000U);
}

void sid_node_set_times(sid_node_t* node) {
    node->master_timeout = ticks_of_ms(node, node->master_timeout_ms);
    node->heartbeat_period = ticks_of_ms(node, node->heartbeat_ms);
    node->heartbeat_due = node->telemetry.written + node->heartbeat_period;
}

static sid_run_t run_of(const sid_node_t* node, uint32_t position_raw) {
    const uint32_t bits = node->identify.position_bits;
    sid_run_t run;
    run.start_tick = 0;
    run.end_tick = 0;
    run.start_raw = position_raw;
    run.position_bits = (uint8_t)((bits != 0U) ? bits : 32U);
    run.position_shift = node->identify.position_shift;
    run.torque_timing = (uint8_t)node->identify.torque_timing;
    return run;
}

bool sid_node_init(sid_node_t* node, const sid_node_config_t* config) {
    const sid_excite_config_t guards = sid_identify_guards(&config->identify);
    memset(node, 0, sizeof(*node));
    node->config = config;
    node->identify = config->identify;
    node->identify.plan = config->plan;
    node->identify.plan_length = 0;
    node->master_id = config->master_id;
    node->master_timeout_ms = config->master_timeout_ms;
    node->heartbeat_ms = config->heartbeat_ms;
    node->planned = SID_RUN_IDENTIFY;
    node->run = run_of(node, 0);
    sid_node_set_times(node);
    return sid_telemetry_init(&node->telemetry, config->rows, config->row_count) &&
           sid_stream_init(&node->stream, config->references, config->reference_count, &guards) &&
           (config->node_id >= 1U) && (config->node_id <= 127U) && (config->plan != NULL) &&
           (config->identify.results != NULL) && (config->plan_capacity >= 1U) &&
           (config->plan_capacity <= 32U) && (config->axis.sample_rate_uHz != 0U);
}

bool sid_node_is_running(const sid_node_t* node) {
    return (node->state == SID_STATE_MEASURING) || (node->state == SID_STATE_STOPPING);
}

bool sid_node_is_reset_requested(const sid_node_t* node) { return node->reset_requested; }

// ---------------------------------------------------------------- interrupt

// A run begins here and nowhere else, so that the reference and its zero change in one sample.
static void begin_run(sid_node_t* node, uint32_t tick) {
    node->next.start_tick = tick;
    node->run = node->next;
    node->kind = node->handover;
    node->handover = SID_RUN_HOLD;
    node->held = 0;
}

// The guards trip on a torque limit of -1, in this very sample.
static void watch_master(sid_node_t* node, uint32_t tick) {
    const int32_t left = (int32_t)(node->master_timeout - (tick - node->master_seen));
    const int32_t lost = (left & node->watched) >> 31;
    node->master_lost |= lost;
    node->session.excite.torque_limit |= lost;
    node->stream.guards.torque_limit |= lost;
}

void sid_node_step(sid_node_t* node, const sid_sample_t* in, sid_command_t* out) {
    const uint32_t tick = node->telemetry.written;
    if (node->handover != SID_RUN_HOLD) {
        begin_run(node, tick);
    }
    watch_master(node, tick);
    if (node->kind == SID_RUN_IDENTIFY) {
        sid_identify_step(&node->session, in, out);
    } else if (node->kind == SID_RUN_STREAM) {
        sid_stream_step(&node->stream, in, out);
    } else {
        out->reference_q8 = node->reference_q8;
        out->held = node->held;
    }
    const int32_t held = out->held >> 31;
    node->held_tick =
        (uint32_t)sid_select(held & ~node->held, (int32_t)tick, (int32_t)node->held_tick);
    node->held = held;
    node->reference_q8 = out->reference_q8;
    sid_telemetry_push(&node->telemetry, in, out->reference_q8);
}

// ---------------------------------------------------------------- runs

static uint32_t last_position(const sid_node_t* node) {
    const sid_telemetry_t* const t = &node->telemetry;
    return t->rows[(t->written - 1U) & t->mask].position_raw;
}

static void hold(sid_node_t* node) {
    node->kind = SID_RUN_HOLD;
    SID_FENCE();
}

uint32_t sid_node_prepare(sid_node_t* node, uint32_t length) {
    const sid_node_config_t* const config = node->config;
    const sid_excite_config_t guards = sid_identify_guards(&node->identify);
    hold(node);
    if (!sid_stream_init(&node->stream, config->references, config->reference_count, &guards) ||
        !sid_stream_prepare(&node->stream, length)) {
        return SID_SDO_RANGE;
    }
    node->run_length = length;
    node->planned = SID_RUN_STREAM;
    node->progress = true;
    return SID_SDO_OK;
}

static bool start_planned(sid_node_t* node, uint32_t position_raw) {
    const uint32_t stuck = node->identify.stuck_limit_pu_q20;
    if (node->planned == SID_RUN_STREAM) {
        return sid_stream_start(&node->stream, position_raw,
                                (stuck != 0U) ? stuck : (uint32_t)1 << 30);
    }
    return sid_identify_init(&node->session, &node->identify) &&
           sid_identify_start(&node->session, position_raw);
}

static void watch_from_now(sid_node_t* node) {
    node->master_seen = node->telemetry.written;
    node->master_lost = 0;
    node->user_abort = false;
    SID_FENCE();
    node->watched = (node->master_timeout != 0U) ? -1 : 0;
}

static void hand_over(sid_node_t* node, uint32_t position_raw) {
    node->next = run_of(node, position_raw);
    node->state = SID_STATE_MEASURING;
    node->reason = SID_NOT_RUN;
    node->run_kind = node->planned;
    node->plan_index = 0;
    node->describe = true;
    SID_FENCE();
    node->handover = node->planned;
}

uint32_t sid_node_start(sid_node_t* node, uint32_t run_number) {
    if ((run_number != 0U) && (run_number == node->run_number)) {
        return SID_SDO_OK; // the answer to the first one was lost
    }
    if (run_number == 0U) {
        return SID_SDO_RANGE;
    }
    if (node->telemetry.written == 0U) {
        return SID_SDO_STATE; // no sample yet
    }
    const uint32_t position_raw = last_position(node);
    hold(node);
    if (!start_planned(node, position_raw)) {
        return SID_SDO_STATE;
    }
    node->run_number = run_number;
    watch_from_now(node);
    hand_over(node, position_raw);
    return SID_SDO_OK;
}

void sid_node_abort(sid_node_t* node) {
    if (sid_node_is_running(node)) {
        node->user_abort = true;
        sid_identify_abort(&node->session);
        sid_stream_abort(&node->stream);
    }
}

static sid_reason_t reason_of_stream(const sid_node_t* node) {
    static const uint8_t reasons[] = {SID_OK, SID_ENCODER_STUCK, SID_ABORTED_STROKE,
                                      SID_ABORTED_TORQUE, SID_ENCODER_JUMP};
    const sid_stream_t* const stream = &node->stream;
    if (stream->starved < 0) {
        return SID_STREAM_STARVED;
    }
    return (sid_reason_t)reasons[sid_excite_trip(&stream->guards)];
}

static void end_run(sid_node_t* node, sid_state_t state, sid_reason_t reason) {
    node->watched = 0;
    node->run.end_tick = node->telemetry.written;
    node->describe = true;
    node->state = (uint8_t)state;
    node->reason = (uint8_t)reason;
    if (node->user_abort) {
        node->reason = SID_ABORTED_BY_USER;
    }
    if (node->master_lost != 0) {
        node->reason = SID_MASTER_LOST;
    }
    node->progress = true;
}

static void advance_identify(sid_node_t* node, uint32_t max_samples) {
    if (node->master_lost != 0) {
        sid_identify_abort(&node->session); // or its counters would say torque
    }
    const sid_state_t state = sid_identify_poll(&node->session, max_samples);
    node->plan_index = node->session.plan_index;
    node->state = (uint8_t)state;
    if (!sid_node_is_running(node)) {
        end_run(node, state, sid_identify_reason(&node->session));
    }
}

static void advance_stream(sid_node_t* node) {
    if (!sid_stream_is_over(&node->stream)) {
        return;
    }
    const sid_reason_t reason = reason_of_stream(node);
    sid_stream_stop(&node->stream);
    end_run(node, (reason == SID_OK) ? SID_STATE_DONE : SID_STATE_ABORTED, reason);
}

static void advance(sid_node_t* node, uint32_t max_samples) {
    if ((node->handover != SID_RUN_HOLD) || !sid_node_is_running(node)) {
        return; // the interrupt has not begun it yet
    }
    if (node->run_kind == SID_RUN_IDENTIFY) {
        advance_identify(node, max_samples);
    } else {
        advance_stream(node);
    }
}

// A master that has gone leaves the drive to the next one.
static void release_if_silent(sid_node_t* node) {
    const uint32_t silence = node->telemetry.written - node->master_seen;
    if ((node->owner != 0U) && (node->master_timeout != 0U) && !sid_node_is_running(node) &&
        (silence > node->master_timeout)) {
        node->owner = 0;
    }
}

// ---------------------------------------------------------------- frames

static void receive_nmt(sid_node_t* node, const sid_can_frame_t* frame) {
    const uint32_t command = frame->data[0];
    if ((frame->length < 2U) ||
        ((frame->data[1] != 0U) && (frame->data[1] != node->config->node_id))) {
        return;
    }
    if ((command == NMT_RESET_NODE) || (command == NMT_RESET_COMMUNICATION)) {
        node->reset_requested = true;
        sid_node_abort(node);
    }
    if (command == NMT_STOP) {
        sid_node_abort(node);
    }
}

static bool serve(sid_node_t* node, const sid_can_frame_t* frame, sid_can_frame_t* answer) {
    sid_sdo_t sdo;
    if (!sid_sdo_parse(frame, &sdo)) {
        return false;
    }
    uint32_t code = SID_SDO_COMMAND;
    if (sdo.known) {
        code = sdo.write ? sid_node_write(node, &sdo) : sid_node_read(node, &sdo);
    }
    sid_sdo_answer(&sdo, code, answer);
    answer->id = SID_ID_ANSWER + node->config->node_id;
    return true;
}

bool sid_node_receive(sid_node_t* node, const sid_can_frame_t* frame, sid_can_frame_t* answer) {
    const uint32_t id = node->config->node_id;
    if (frame->id == SID_ID_NMT) {
        receive_nmt(node, frame);
    } else if (frame->id == SID_ID_HEARTBEAT + node->master_id) {
        node->master_seen = node->telemetry.written;
    } else if (frame->id == SID_ID_REFERENCES + id) {
        (void)sid_stream_receive(&node->stream, frame);
        node->progress = true;
    } else if (frame->id == SID_ID_REQUEST + id) {
        return serve(node, frame, answer);
    } else {
        // not for us
    }
    return false;
}

static bool heartbeat(sid_node_t* node, uint8_t state, sid_can_frame_t* frame) {
    memset(frame, 0, sizeof(*frame));
    frame->id = SID_ID_HEARTBEAT + node->config->node_id;
    frame->length = 1;
    frame->data[0] = state;
    node->booted = true;
    node->heartbeat_due = node->telemetry.written + node->heartbeat_period;
    return true;
}

static bool is_heartbeat_due(const sid_node_t* node) {
    return (node->heartbeat_period != 0U) &&
           ((int32_t)(node->telemetry.written - node->heartbeat_due) >= 0);
}

static bool poll_telemetry(sid_node_t* node, sid_can_frame_t* frame) {
    frame->id = SID_ID_TELEMETRY + node->config->node_id;
    if (node->progress) {
        node->progress = false;
        sid_telemetry_progress(&node->telemetry, node->state, node->stream.filled,
                               node->stream.played, frame);
        return true;
    }
    if ((node->telemetry_on == 0U) && !node->flush) {
        return false;
    }
    if (node->describe && (node->handover == SID_RUN_HOLD)) {
        node->describe = false;
        sid_telemetry_describe(&node->telemetry, &node->config->axis, &node->run, frame);
        return true;
    }
    const bool packed = sid_telemetry_pack(&node->telemetry, node->state, node->flush, frame);
    node->describe = packed && (node->telemetry.sequence % DESCRIBE_EVERY == 0U);
    node->flush = node->flush && packed;
    return packed;
}

bool sid_node_poll(sid_node_t* node, uint32_t max_samples, sid_can_frame_t* frame) {
    advance(node, max_samples);
    release_if_silent(node);
    if (!node->booted) {
        return heartbeat(node, BOOTED_UP, frame);
    }
    if (is_heartbeat_due(node)) {
        return heartbeat(node, OPERATIONAL, frame);
    }
    return poll_telemetry(node, frame);
}
