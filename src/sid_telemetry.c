#include "servoid/sid_telemetry.h"

#include <string.h>

#define ROW_BYTES 11U
#define HEADER_BYTES 8U
#define STATE_BYTE 63U
#define TORQUE_LIMIT ((1 << 23) - 1)

SID_STATIC_ASSERT(HEADER_BYTES + SID_TELEMETRY_ROWS * ROW_BYTES == STATE_BYTE, rows_fill_a_frame);

bool sid_telemetry_init(sid_telemetry_t* telemetry, sid_row_t* rows, uint32_t count) {
    memset(telemetry, 0, sizeof(*telemetry));
    telemetry->rows = rows;
    telemetry->mask = count - 1U;
    return (rows != NULL) && (count >= 16U) && ((count & (count - 1U)) == 0U);
}

void sid_telemetry_skip(sid_telemetry_t* telemetry) { telemetry->read = telemetry->written; }

static void begin_frame(sid_telemetry_t* telemetry, uint8_t kind, uint32_t tick, uint8_t length,
                        sid_can_frame_t* frame) {
    memset(frame->data, 0, sizeof(frame->data));
    frame->fd = true;
    frame->length = length;
    frame->data[0] = kind;
    sid_put_u16(&frame->data[2], telemetry->sequence++);
    sid_put_u32(&frame->data[4], tick);
}

static void put_row(const sid_row_t* row, uint8_t* at) {
    const uint32_t torque = (uint32_t)sid_clamp(row->torque_pu_q20, -TORQUE_LIMIT, TORQUE_LIMIT);
    sid_put_u32(at, row->position_raw);
    sid_put_u32(at + 4, (uint32_t)row->reference_q8);
    sid_put_u16(at + 8, (uint16_t)(torque & 0xFFFFU));
    at[10] = (uint8_t)((torque >> 16) & 0xFFU);
}

// The row that the interrupt writes next is not the reader's.
static void pass_over_lost(sid_telemetry_t* t) {
    const uint32_t waiting = t->written - t->read;
    if (waiting > t->mask) {
        const uint32_t keep = (t->mask + 1U) / 2U;
        t->lost += waiting - keep;
        t->read += waiting - keep;
    }
}

bool sid_telemetry_pack(sid_telemetry_t* telemetry, uint8_t state, bool flush,
                        sid_can_frame_t* frame) {
    pass_over_lost(telemetry);
    const uint32_t waiting = telemetry->written - telemetry->read;
    const uint32_t rows = (waiting < SID_TELEMETRY_ROWS) ? waiting : SID_TELEMETRY_ROWS;
    if ((rows == 0U) || ((rows < SID_TELEMETRY_ROWS) && !flush)) {
        return false;
    }
    begin_frame(telemetry, SID_FRAME_SAMPLES, telemetry->read, SID_CAN_BYTES, frame);
    frame->data[1] = (uint8_t)rows;
    for (uint32_t i = 0; i < rows; i++) {
        put_row(&telemetry->rows[(telemetry->read + i) & telemetry->mask],
                &frame->data[HEADER_BYTES + i * ROW_BYTES]);
    }
    frame->data[STATE_BYTE] = state;
    SID_FENCE();
    if ((telemetry->written - telemetry->read) > telemetry->mask) { // overwritten meanwhile
        telemetry->sequence--;
        return false;
    }
    telemetry->read += rows;
    return true;
}

static void put_scaled(sid_scaled_t value, uint8_t* mantissa, uint8_t* exponent) {
    sid_put_u32(mantissa, (uint32_t)value.mantissa);
    sid_put_u16(exponent, (uint16_t)value.exponent);
}

void sid_telemetry_describe(sid_telemetry_t* telemetry, const sid_axis_t* axis,
                            const sid_run_t* run, sid_can_frame_t* frame) {
    uint8_t* const data = frame->data;
    begin_frame(telemetry, SID_FRAME_DESCRIPTION, telemetry->written, 48, frame);
    data[1] = SID_TELEMETRY_VERSION;
    sid_put_u32(&data[8], (uint32_t)(axis->sample_rate_uHz & 0xFFFFFFFFU));
    sid_put_u32(&data[12], (uint32_t)(axis->sample_rate_uHz >> 32));
    put_scaled(axis->rated_torque, &data[16], &data[20]);
    put_scaled(axis->count, &data[24], &data[22]);
    sid_put_u32(&data[32], run->start_tick);
    sid_put_u32(&data[36], run->end_tick);
    sid_put_u32(&data[40], run->start_raw);
    data[44] = run->position_bits;
    data[45] = run->position_shift;
    data[46] = run->torque_timing;
    data[47] = axis->linear ? 1U : 0U;
}

void sid_telemetry_progress(sid_telemetry_t* telemetry, uint8_t state, uint32_t filled,
                            uint32_t played, sid_can_frame_t* frame) {
    begin_frame(telemetry, SID_FRAME_PROGRESS, filled, 12, frame);
    frame->data[1] = state;
    sid_put_u32(&frame->data[8], played);
}
