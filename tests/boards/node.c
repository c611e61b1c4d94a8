// A drive on a bus, commanded by a master in the same program: the node is stepped by the timer
// interrupt and polled all the time in between. A session finds the inertia while every sample goes
// out as telemetry; a second one, whose master falls silent while the main loop hangs, is held
// by the interrupt itself.
#include "board.h"
#include "drive.h"

#define NODE 5U
#define MASTER 127U
#define ROWS 256U
#define REFERENCES 64U
#define TIMEOUT_MS 100U
#define MOST_SAMPLES 20000U
#define HEARTBEATS 400U // samples after which the master falls silent
#define DEAD 1500U      // samples for which the main loop does

static sid_node_t node;
static sid_node_config_t config;
static sid_row_t rows[ROWS];
static int32_t references[REFERENCES];
static uint32_t sample_frames;
static volatile int is_in_poll;
static volatile int64_t interrupted;

static void look(sid_sample_t* sample, uint32_t index) {
    (void)sample;
    (void)index;
    interrupted += is_in_poll;
}

static bool power_up(void) {
    drive_power_up();
    drive.fault = look;
    config.axis.sample_rate_uHz = sid_hal_sample_rate_uHz();
    config.axis.rated_torque = sid_scaled_make(637, -10);
    config.identify = drive.config;
    config.plan = drive.plan;
    config.plan_capacity = DRIVE_PLAN;
    config.node_id = NODE;
    config.master_id = MASTER;
    config.master_timeout_ms = TIMEOUT_MS;
    config.rows = rows;
    config.row_count = ROWS;
    config.references = references;
    config.reference_count = REFERENCES;
    drive.node = &node;
    return sid_node_init(&node, &config);
}

// ---------------------------------------------------------------- master

static bool write(uint16_t index, uint8_t sub, uint32_t value, uint32_t bytes) {
    sid_can_frame_t frame = {SID_ID_REQUEST + NODE, 8, false, {0}};
    sid_can_frame_t answer;
    frame.data[0] = (uint8_t)(0x23U | ((4U - bytes) << 2));
    sid_put_u16(&frame.data[1], index);
    frame.data[3] = sub;
    sid_put_u32(&frame.data[4], value);
    return sid_node_receive(&node, &frame, &answer) && (answer.data[0] == 0x60U);
}

static void give_heartbeat(void) {
    const sid_can_frame_t frame = {SID_ID_HEARTBEAT + MASTER, 1, false, {5}};
    sid_can_frame_t answer;
    (void)sid_node_receive(&node, &frame, &answer);
}

static bool start(uint32_t run) {
    give_heartbeat();
    return write(0x2A01, 1, 77, 4) && write(0x2A01, 6, 1, 1) && write(0x2A05, 1, 100000000, 4) &&
           write(0x2A06, 1, (uint32_t)drive.plan[1].amplitude_q8, 4) && write(0x2A03, 1, 1, 1) &&
           write(0x2A01, 2, SID_RUN_IDENTIFY, 1) && write(0x2A01, 4, run, 4);
}

// ---------------------------------------------------------------- main loop

static void serve_bus(void) {
    sid_can_frame_t frame;
    is_in_poll = 1;
    while (sid_node_poll(&node, 64, &frame)) {
        sample_frames += (frame.data[0] == SID_FRAME_SAMPLES) ? 1U : 0U;
    }
    is_in_poll = 0;
}

// Until the run has ended. The master speaks in the first samples only, and with it the main loop
// stops for longer than the master may be silent: nobody but the interrupt can hold the axis.
static void run_out(uint32_t heartbeats) {
    const uint32_t begun = drive.samples;
    while (sid_node_is_running(&node) && (drive.samples - begun < MOST_SAMPLES)) {
        while (drive.samples == drive.moved) {
            if ((drive.samples - begun <= heartbeats) ||
                (drive.samples - begun > heartbeats + DEAD)) {
                serve_bus();
            }
        }
        drive_move_axis();
        drive.moved++;
        if (drive.samples - begun < heartbeats) {
            give_heartbeat();
        }
    }
    serve_bus();
}

static void say(const char* name, int64_t value) {
    board_print(name);
    board_print_int(value);
}

static bool find_inertia(void) {
    const bool started = start(1);
    run_out(MOST_SAMPLES);
    const int64_t found_e12 = drive_inertia_e12(&drive.results[0]);
    const uint32_t unsent = node.telemetry.written - 5U * sample_frames;
    say("J ", found_e12);
    say("e-12 kg m^2, telemetry ", node.telemetry.written);
    say(" rows, lost ", node.telemetry.lost);
    say(", not sent ", unsent);
    say(", polls interrupted ", interrupted);
    board_print("\n");
    return started && (node.reason == SID_OK) && (found_e12 > 11426000) && (found_e12 < 11774000) &&
           (node.telemetry.lost == 0U) && (unsent < 5U) && (interrupted > 500);
}

static bool lose_master(void) {
    const bool started = start(2);
    const uint32_t begun = node.telemetry.written;
    run_out(HEARTBEATS);
    const uint32_t held_after = node.held_tick - begun;
    board_print(sid_reason_text((sid_reason_t)node.reason));
    say(", held after ", held_after);
    board_print(" samples\n");
    const uint32_t due = HEARTBEATS + TIMEOUT_MS * DRIVE_RATE_HZ / 1000U;
    return started && (node.reason == SID_MASTER_LOST) && (held_after >= due - 4U) &&
           (held_after <= due + 4U);
}

int main(void) {
    if (!power_up()) {
        return 2;
    }
    board_timer_start(DRIVE_RATE_HZ);
    board_interrupt_on();
    while (drive.samples == 0U) {
    }
    drive.moved = drive.samples;
    const bool found = find_inertia();
    return (lose_master() && found) ? 0 : 1;
}
