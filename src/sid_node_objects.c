#include "sid_node_objects.h"

#include <stddef.h>
#include <string.h>

#define ERROR_REGISTER 0x1001U
#define MASTER_HEARTBEAT 0x1016U
#define OWN_HEARTBEAT 0x1017U
#define RATED_TORQUE 0x6076U
#define ENCODER 0x608FU
#define AXIS 0x2A00U
#define COMMAND 0x2A01U
#define STATUS 0x2A02U
#define OPTIONS 0x2A03U
#define LIMITS 0x2A04U
#define FREQUENCIES 0x2A05U
#define AMPLITUDES 0x2A06U
#define COUNTERS 0x2A08U
#define RESULTS 0x2A10U

// ---------------------------------------------------------------- fields of the structures

// An object that is a field of sid_node_t as it stands.
typedef struct {
    uint16_t index;
    uint8_t sub;
    uint8_t size;
    uint16_t offset;
} field_t;

#define FIELD(index, sub, size, member)                                                            \
    { index, sub, size, (uint16_t)offsetof(sid_node_t, member) }

static const field_t fields[] = {
    FIELD(OWN_HEARTBEAT, 0, 2, heartbeat_ms),
    FIELD(AXIS, 9, 1, identify.position_bits),
    FIELD(AXIS, 10, 1, identify.position_shift),
    FIELD(COMMAND, 1, 4, owner),
    FIELD(COMMAND, 2, 1, planned),
    FIELD(COMMAND, 3, 4, run_length),
    FIELD(COMMAND, 4, 4, run_number),
    FIELD(COMMAND, 6, 1, telemetry_on),
    FIELD(STATUS, 1, 1, state),
    FIELD(STATUS, 2, 1, reason),
    FIELD(STATUS, 3, 1, plan_index),
    FIELD(STATUS, 4, 4, telemetry.written),
    FIELD(STATUS, 5, 4, telemetry.lost),
    FIELD(STATUS, 6, 4, stream.filled),
    FIELD(STATUS, 7, 4, stream.played),
    FIELD(STATUS, 8, 4, stream.refused),
    FIELD(STATUS, 9, 4, held_tick),
    FIELD(STATUS, 10, 4, run.start_tick),
    FIELD(STATUS, 11, 4, run.start_raw),
    FIELD(OPTIONS, 1, 1, identify.plan_length),
    FIELD(OPTIONS, 2, 1, identify.windows),
    FIELD(OPTIONS, 3, 2, identify.ramp_periods_q8),
    FIELD(OPTIONS, 4, 2, identify.settle_periods_q8),
    FIELD(OPTIONS, 5, 2, identify.window_periods_q8),
    FIELD(OPTIONS, 6, 2, identify.gap_periods_q8),
    FIELD(OPTIONS, 7, 4, identify.rest_samples),
    FIELD(LIMITS, 1, 4, identify.torque_limit_pu_q20),
    FIELD(LIMITS, 2, 4, identify.stroke_limit_count),
    FIELD(LIMITS, 3, 4, identify.step_limit_count),
    FIELD(LIMITS, 4, 4, identify.stuck_limit_pu_q20),
    FIELD(LIMITS, 5, 4, identify.torque_saturation_pu_q20),
    FIELD(LIMITS, 6, 4, identify.torque_min_pu_q20),
    FIELD(LIMITS, 7, 4, identify.position_min_q8),
    FIELD(COUNTERS, 1, 4, session.counters.torque_saturated_samples),
    FIELD(COUNTERS, 2, 4, session.counters.torque_aborts),
    FIELD(COUNTERS, 3, 4, session.counters.stroke_aborts),
    FIELD(COUNTERS, 4, 4, session.counters.encoder_jumps),
    FIELD(COUNTERS, 5, 4, session.counters.encoder_stuck),
    FIELD(COUNTERS, 6, 4, session.counters.user_aborts),
    FIELD(COUNTERS, 7, 4, session.counters.missed_polls),
};

static const field_t* find_field(const sid_sdo_t* sdo) {
    for (uint32_t i = 0; i < sizeof(fields) / sizeof(fields[0]); i++) {
        if ((fields[i].index == sdo->index) && (fields[i].sub == sdo->sub)) {
            return &fields[i];
        }
    }
    return NULL;
}

static uint32_t load(const sid_node_t* node, const field_t* field) {
    const uint8_t* const at = (const uint8_t*)node + field->offset;
    uint32_t whole = 0;
    uint16_t half = 0;
    if (field->size == 4U) {
        memcpy(&whole, at, sizeof(whole));
        return whole;
    }
    if (field->size == 2U) {
        memcpy(&half, at, sizeof(half));
        return half;
    }
    return *at;
}

static void store(sid_node_t* node, const field_t* field, uint32_t value) {
    uint8_t* const at = (uint8_t*)node + field->offset;
    const uint16_t half = (uint16_t)(value & 0xFFFFU);
    if (field->size == 4U) {
        memcpy(at, &value, sizeof(value));
    } else if (field->size == 2U) {
        memcpy(at, &half, sizeof(half));
    } else {
        *at = (uint8_t)(value & 0xFFU);
    }
}

// ---------------------------------------------------------------- reading

static uint32_t give(sid_sdo_t* sdo, uint32_t value, uint8_t size) {
    sdo->value = value;
    sdo->size = size;
    return SID_SDO_OK;
}

static uint32_t give_mantissa(sid_sdo_t* sdo, sid_scaled_t value) {
    return give(sdo, (uint32_t)value.mantissa, 4);
}

static uint32_t give_exponent(sid_sdo_t* sdo, sid_scaled_t value) {
    return give(sdo, (uint16_t)value.exponent, 2);
}

static uint32_t read_axis(const sid_node_t* node, sid_sdo_t* sdo) {
    const sid_axis_t* const axis = &node->config->axis;
    const uint32_t timing = (uint32_t)node->identify.torque_timing;
    switch (sdo->sub) {
    case 1:
        return give(sdo, SID_TELEMETRY_VERSION, 1);
    case 2:
        return give(sdo, (uint32_t)(axis->sample_rate_uHz & 0xFFFFFFFFU), 4);
    case 3:
        return give(sdo, (uint32_t)(axis->sample_rate_uHz >> 32), 4);
    case 4:
        return give_mantissa(sdo, axis->rated_torque);
    case 5:
        return give_exponent(sdo, axis->rated_torque);
    case 6:
        return give_mantissa(sdo, axis->count);
    case 7:
        return give_exponent(sdo, axis->count);
    case 8:
        return give(sdo, (axis->linear ? 1U : 0U) | (timing << 1), 1);
    case 11:
        return give(sdo, node->config->plan_capacity, 1);
    case 12:
        return give(sdo, node->config->reference_count, 4);
    default:
        return SID_SDO_NO_SUB;
    }
}

// 1000 times the rated torque, as CiA 402 has it; rounded.
static uint32_t rated_milli(const sid_axis_t* axis) {
    return (uint32_t)sid_scaled_to_fixed(
        sid_scaled_mul(axis->rated_torque, sid_scaled_make(1000, 0)), 0);
}

static uint32_t read_cia402(const sid_node_t* node, sid_sdo_t* sdo) {
    const sid_axis_t* const axis = &node->config->axis;
    if ((sdo->index == RATED_TORQUE) && (sdo->sub == 0U)) {
        return give(sdo, rated_milli(axis), 4);
    }
    if ((sdo->index == ENCODER) && (sdo->sub == 1U)) {
        return give(sdo, axis->encoder_increments, 4);
    }
    if ((sdo->index == ENCODER) && (sdo->sub == 2U)) {
        return give(sdo, axis->encoder_revolutions, 4);
    }
    return SID_SDO_NO_SUB;
}

// sub 1 reason, 2 windows, 3 std known; then mantissa and exponent of nine numbers.
static uint32_t read_result(const sid_result_t* result, sid_sdo_t* sdo) {
    const sid_scaled_t numbers[] = {
        result->inertia,         result->inertia_std,       result->viscous,
        result->viscous_std,     result->torque_amplitude,  result->position_amplitude,
        result->torque_residual, result->position_residual, result->smallest_pivot};
    const uint32_t place = (uint32_t)sdo->sub - 4U;
    switch (sdo->sub) {
    case 1:
        return give(sdo, result->reason, 1);
    case 2:
        return give(sdo, result->windows, 1);
    case 3:
        return give(sdo, result->std_known ? 1U : 0U, 1);
    default:
        break;
    }
    if (place >= 2U * (sizeof(numbers) / sizeof(numbers[0]))) {
        return SID_SDO_NO_SUB;
    }
    return ((place & 1U) == 0U) ? give_mantissa(sdo, numbers[place / 2U])
                                : give_exponent(sdo, numbers[place / 2U]);
}

static bool is_entry(const sid_node_t* node, uint32_t sub) {
    return (sub >= 1U) && (sub <= node->config->plan_capacity);
}

static uint32_t read_amplitude(const sid_node_t* node, sid_sdo_t* sdo) {
    if (!is_entry(node, sdo->sub)) {
        return SID_SDO_NO_SUB;
    }
    return give(sdo, (uint32_t)node->config->plan[sdo->sub - 1U].amplitude_q8, 4);
}

uint32_t sid_node_read(const sid_node_t* node, sid_sdo_t* sdo) {
    const field_t* const field = find_field(sdo);
    const uint32_t entry = (uint32_t)sdo->index - RESULTS;
    if (field != NULL) {
        return give(sdo, load(node, field), field->size);
    }
    if (entry < node->config->plan_capacity) {
        return read_result(&node->config->identify.results[entry], sdo);
    }
    switch (sdo->index) {
    case ERROR_REGISTER:
        return give(sdo, (node->state == SID_STATE_ABORTED) ? 1U : 0U, 1);
    case MASTER_HEARTBEAT:
        return give(sdo, ((uint32_t)node->master_id << 16) | node->master_timeout_ms, 4);
    case AXIS:
        return read_axis(node, sdo);
    case AMPLITUDES:
        return read_amplitude(node, sdo);
    case FREQUENCIES:
        return SID_SDO_WRITE_ONLY;
    case OPTIONS:
        return (sdo->sub == 8U) ? give(sdo, node->identify.method, 1) : SID_SDO_NO_SUB;
    case RATED_TORQUE:
    case ENCODER:
        return read_cia402(node, sdo);
    case COMMAND:
    case STATUS:
    case LIMITS:
    case COUNTERS:
        return SID_SDO_NO_SUB;
    default:
        return SID_SDO_NO_OBJECT;
    }
}

// ---------------------------------------------------------------- writing

static uint32_t claim(sid_node_t* node, uint32_t master) {
    if ((master != 0U) && (node->owner != 0U) && (master != node->owner)) {
        return SID_SDO_STATE;
    }
    if ((master == 0U) && sid_node_is_running(node)) {
        return SID_SDO_STATE;
    }
    node->owner = master;
    node->master_seen = node->telemetry.written;
    return SID_SDO_OK;
}

static uint32_t turn_telemetry(sid_node_t* node, uint32_t value) {
    if (value > 1U) {
        return SID_SDO_RANGE;
    }
    if ((value == 1U) && (node->telemetry_on == 0U)) {
        sid_telemetry_skip(&node->telemetry);
        node->describe = true;
    }
    node->flush = (value == 0U) && (node->telemetry_on == 1U);
    node->telemetry_on = (uint8_t)value;
    return SID_SDO_OK;
}

static uint32_t command(sid_node_t* node, const sid_sdo_t* sdo) {
    switch (sdo->sub) {
    case 2:
        if (sdo->value != SID_RUN_IDENTIFY) {
            return SID_SDO_RANGE; // a streamed move is planned by its length
        }
        node->planned = SID_RUN_IDENTIFY;
        return SID_SDO_OK;
    case 3:
        return sid_node_prepare(node, sdo->value);
    case 4:
        return sid_node_start(node, sdo->value);
    default:
        return SID_SDO_NO_SUB;
    }
}

// A master may tighten what the drive was configured with; 0 gives that back.
static uint32_t set_limit(sid_node_t* node, const sid_sdo_t* sdo, const field_t* field) {
    const sid_identify_config_t* const widest = &node->config->identify;
    const uint32_t most[] = {(uint32_t)widest->torque_limit_pu_q20,
                             (uint32_t)widest->stroke_limit_count,
                             (uint32_t)widest->step_limit_count, widest->stuck_limit_pu_q20,
                             (uint32_t)widest->torque_saturation_pu_q20};
    const uint32_t top = (sdo->sub <= 5U) ? most[sdo->sub - 1U] : 0U;
    if ((sdo->value > (uint32_t)INT32_MAX) || ((top != 0U) && (sdo->value > top))) {
        return SID_SDO_RANGE;
    }
    store(node, field, (sdo->value != 0U) ? sdo->value : top);
    return SID_SDO_OK;
}

static uint32_t set_frequency(sid_node_t* node, const sid_sdo_t* sdo) {
    if (!is_entry(node, sdo->sub)) {
        return SID_SDO_NO_SUB;
    }
    const uint64_t increment = sid_phase_increment(sdo->value, node->config->axis.sample_rate_uHz);
    if (increment == 0U) {
        return SID_SDO_RANGE;
    }
    node->config->plan[sdo->sub - 1U].increment_q64 = increment;
    return SID_SDO_OK;
}

static uint32_t set_amplitude(sid_node_t* node, const sid_sdo_t* sdo) {
    if (!is_entry(node, sdo->sub)) {
        return SID_SDO_NO_SUB;
    }
    if (sdo->value >= ((uint32_t)1 << 30)) {
        return SID_SDO_RANGE;
    }
    node->config->plan[sdo->sub - 1U].amplitude_q8 = (int32_t)sdo->value;
    return SID_SDO_OK;
}

static uint32_t set_option(sid_node_t* node, const sid_sdo_t* sdo, const field_t* field) {
    if ((sdo->sub == 8U) && (sdo->value <= (uint32_t)SID_BIN_PLAIN_DFT)) {
        node->identify.method = (sid_bin_method_t)sdo->value;
        return SID_SDO_OK;
    }
    if (sdo->sub == 8U) {
        return SID_SDO_RANGE;
    }
    if (field == NULL) {
        return SID_SDO_NO_SUB;
    }
    if ((sdo->sub == 1U) && !is_entry(node, sdo->value)) {
        return SID_SDO_RANGE;
    }
    store(node, field, sdo->value);
    return SID_SDO_OK;
}

// Only by a master that has claimed the node, and only while nothing runs.
static uint32_t write_plan(sid_node_t* node, const sid_sdo_t* sdo, const field_t* field) {
    const bool again =
        (sdo->index == COMMAND) && (sdo->sub == 4U) && (sdo->value == node->run_number);
    if ((node->owner == 0U) || (sid_node_is_running(node) && !again)) {
        return SID_SDO_STATE;
    }
    switch (sdo->index) {
    case COMMAND:
        return command(node, sdo);
    case OPTIONS:
        return set_option(node, sdo, field);
    case LIMITS:
        return (field != NULL) ? set_limit(node, sdo, field) : SID_SDO_NO_SUB;
    case FREQUENCIES:
        return set_frequency(node, sdo);
    case AMPLITUDES:
        return set_amplitude(node, sdo);
    default:
        return (field != NULL) ? SID_SDO_READ_ONLY : SID_SDO_NO_OBJECT;
    }
}

// A drive that is configured to watch its master goes on watching.
static uint32_t set_times(sid_node_t* node, const sid_sdo_t* sdo) {
    const uint16_t ms = (uint16_t)(sdo->value & 0xFFFFU);
    if (sdo->index == OWN_HEARTBEAT) {
        node->heartbeat_ms = ms;
    } else if ((ms == 0U) && (node->config->master_timeout_ms != 0U)) {
        return SID_SDO_RANGE;
    } else {
        node->master_timeout_ms = ms;
        node->master_id = (uint8_t)((sdo->value >> 16) & 0x7FU);
    }
    sid_node_set_times(node);
    return SID_SDO_OK;
}

static uint8_t size_of(const sid_sdo_t* sdo, const field_t* field) {
    if (field != NULL) {
        return field->size;
    }
    const bool one_byte = ((sdo->index == OPTIONS) && (sdo->sub == 8U)) ||
                          ((sdo->index == COMMAND) && (sdo->sub == 5U));
    return one_byte ? 1U : 4U;
}

uint32_t sid_node_write(sid_node_t* node, const sid_sdo_t* sdo) {
    const field_t* const field = find_field(sdo);
    if ((sdo->size != 0U) && (sdo->size != size_of(sdo, field))) {
        return SID_SDO_LENGTH;
    }
    if ((sdo->index == COMMAND) && (sdo->sub == 5U)) {
        sid_node_abort(node); // anybody may
        return SID_SDO_OK;
    }
    if ((sdo->index == COMMAND) && (sdo->sub == 1U)) {
        return claim(node, sdo->value);
    }
    if ((sdo->index == COMMAND) && (sdo->sub == 6U)) {
        return turn_telemetry(node, sdo->value);
    }
    if (((sdo->index == MASTER_HEARTBEAT) && (sdo->sub == 1U)) ||
        ((sdo->index == OWN_HEARTBEAT) && (sdo->sub == 0U))) {
        return sid_node_is_running(node) ? SID_SDO_STATE : set_times(node, sdo);
    }
    return write_plan(node, sdo, field);
}
