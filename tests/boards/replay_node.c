#include "board.h"
#include "replay.h"

#define NODE 5U
#define MASTER 127U
#define ROWS 64U
#define REFERENCES 256U

static sid_node_t node;
static sid_node_config_t config;
static sid_frequency_t plan[2];
static sid_result_t results[2];
static sid_row_t rows[ROWS];
static int32_t references[REFERENCES];
static replay_digest_t digest;
static uint32_t frames;

static void take(const sid_can_frame_t* frame) {
    replay_digest(&digest, frame->id);
    replay_digest(&digest, frame->length);
    for (uint32_t i = 0; i < frame->length; i++) {
        replay_digest(&digest, frame->data[i]);
    }
    frames++;
}

static void give(uint32_t id, const uint8_t* data, uint8_t length) {
    sid_can_frame_t frame = {0, 0, false, {0}};
    sid_can_frame_t answer;
    frame.id = id;
    frame.length = length;
    for (uint32_t i = 0; i < length; i++) {
        frame.data[i] = data[i];
    }
    if (sid_node_receive(&node, &frame, &answer)) {
        take(&answer);
    }
}

static void write(uint16_t index, uint8_t sub, uint32_t value, uint32_t bytes) {
    uint8_t data[8];
    data[0] = (uint8_t)(0x23U | ((4U - bytes) << 2));
    sid_put_u16(&data[1], index);
    data[3] = sub;
    sid_put_u32(&data[4], value);
    give(SID_ID_REQUEST + NODE, data, 8);
}

static void advance(uint32_t samples, int32_t position_scale) {
    static const uint8_t operational = 5;
    for (uint32_t i = 0; i < samples; i++) {
        const uint32_t tick = node.session.excite.tick;
        const uint32_t step = (uint32_t)(node.session.excite.increment_q64 >> 32);
        const int32_t sine = (tick < SID_TICK_PARKED) ? replay_sine(step * tick) : 0;
        sid_can_frame_t frame;
        sid_command_t out;
        sid_sample_t in;
        in.position_raw = (uint32_t)((sine * position_scale) >> 15) + (i & 1U);
        in.torque_pu_q20 = -4 * sine + (int32_t)(replay_random() >> 22);
        sid_node_step(&node, &in, &out);
        replay_digest(&digest, (uint32_t)out.reference_q8);
        if (i % 100U == 0U) {
            give(SID_ID_HEARTBEAT + MASTER, &operational, 1);
        }
        while (sid_node_poll(&node, 64, &frame)) {
            take(&frame);
        }
    }
}

static bool power_up(void) {
    config.axis.sample_rate_uHz = 8000000000U;
    config.axis.rated_torque = sid_scaled_make(637, -10);
    config.axis.count = sid_scaled_make(1686629713, -30 - 16);
    config.axis.encoder_increments = 131072;
    config.axis.encoder_revolutions = 1;
    config.identify.results = results;
    config.identify.position_bits = 17;
    config.identify.stroke_limit_count = 60000;
    config.plan = plan;
    config.plan_capacity = 2;
    config.node_id = NODE;
    config.master_id = MASTER;
    config.master_timeout_ms = 100;
    config.heartbeat_ms = 50;
    config.rows = rows;
    config.row_count = ROWS;
    config.references = references;
    config.reference_count = REFERENCES;
    return sid_node_init(&node, &config);
}

static void print(const char* what) {
    board_print("node: ");
    board_print(what);
    replay_print("state", node.state);
    replay_print("reason", node.reason);
    replay_print("frames", frames);
    replay_print("digest", (int64_t)digest.sum);
    replay_print_scaled("J", results[0].inertia);
    replay_end_line();
}

static void run_session(void) {
    write(0x2A01, 1, 77, 4);
    write(0x2A05, 1, 100000000, 4);
    write(0x2A06, 1, 300000, 4);
    write(0x2A03, 1, 1, 1);
    write(0x2A01, 6, 1, 1);
    write(0x2A01, 2, SID_RUN_IDENTIFY, 1);
    write(0x2A01, 4, 1, 4);
    advance(1500, 1000);
    print("session");
}

static void run_stream(void) {
    uint8_t data[64];
    write(0x2A01, 3, 28, 4);
    for (uint32_t first = 0; first < 28U; first += 14U) {
        data[0] = 1;
        data[1] = 14;
        sid_put_u16(&data[2], 0);
        sid_put_u32(&data[4], first);
        for (uint32_t i = 0; i < 14U; i++) {
            sid_put_u32(&data[8U + 4U * i], replay_random() >> 12);
        }
        give(SID_ID_REFERENCES + NODE, data, 64);
    }
    write(0x2A01, 4, 2, 4);
    advance(60, 0);
    print("stream");
}

void replay_node(void) {
    board_print(power_up() ? "node\n" : "node refused\n");
    advance(10, 0);
    run_session();
    run_stream();
}
