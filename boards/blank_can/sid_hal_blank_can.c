// An empty port of a drive on a CAN bus: copy this folder, replace every line marked PORT.
// It compiles and does nothing.
#include "servoid/servoid.h"

// ---------------------------------------------------------------- the functions

void sid_hal_read(sid_sample_t* sample) {
    sample->position_raw = 0;  // PORT: the encoder's counter register
    sample->torque_pu_q20 = 0; // PORT: torque reference * 2^20 / rated torque
}

void sid_hal_write_reference(int32_t reference_q8) {
    (void)reference_q8; // PORT: position reference, Q8 counts from node.run.start_raw
}

uint64_t sid_hal_sample_rate_uHz(void) {
    return 8000000000U; // PORT: 8 kHz
}

void sid_hal_enter_critical(void) {} // PORT: only if the main loop can preempt the interrupt
void sid_hal_exit_critical(void) {}

bool sid_hal_can_receive(sid_can_frame_t* frame) {
    (void)frame; // PORT: the controller's receive queue; never wait
    return false;
}

bool sid_hal_can_send(const sid_can_frame_t* frame) {
    (void)frame; // PORT: the controller's transmit queue; false if it is full
    return true;
}

// ---------------------------------------------------------------- the node

#define PLAN 4U
#define ROWS 512U       // PORT: 64 ms of telemetry at 8 kHz, 6 KiB
#define REFERENCES 512U // PORT: 64 ms of a streamed move, 2 KiB

static sid_node_t node;
static sid_node_config_t config;
static sid_frequency_t plan[PLAN];
static sid_result_t results[PLAN];
static sid_row_t rows[ROWS];
static int32_t references[REFERENCES];

// PORT: the name of the control interrupt in the vector table
void blank_control_interrupt(void);
void blank_control_interrupt(void) {
    sid_sample_t sample;
    sid_command_t command;
    sid_hal_read(&sample);
    sid_node_step(&node, &sample, &command);
    sid_hal_write_reference(command.reference_q8);
}

static bool power_up(void) {
    config.axis.sample_rate_uHz = sid_hal_sample_rate_uHz();
    config.axis.rated_torque = sid_scaled_make(637, -10);      // PORT: N m
    config.axis.count = sid_scaled_make(1686629713, -30 - 16); // PORT: rad; here 2 pi / 2^18
    config.axis.encoder_increments = 262144;                   // PORT
    config.axis.encoder_revolutions = 1;                       // PORT
    config.identify.results = results;
    config.identify.position_bits = 16;            // PORT
    config.identify.stroke_limit_count = 5000;     // PORT
    config.identify.torque_limit_pu_q20 = 1 << 20; // PORT: rated torque
    config.identify.torque_timing = SID_TORQUE_HELD_LAST;
    config.plan = plan;
    config.plan_capacity = PLAN;
    config.node_id = 1;             // PORT
    config.master_id = 127;         // PORT
    config.master_timeout_ms = 100; // PORT
    config.heartbeat_ms = 100;      // PORT
    config.rows = rows;
    config.row_count = ROWS;
    config.references = references;
    config.reference_count = REFERENCES;
    return sid_node_init(&node, &config);
}

// What the bus did not take waits here, and keeps its place.
static sid_can_frame_t pending;
static bool is_pending;

static void give(bool is_new) {
    is_pending = is_new || is_pending;
    if (is_pending && sid_hal_can_send(&pending)) {
        is_pending = false;
    }
}

// What the node has to say comes first: its boot-up before any answer.
static void serve_bus(void) {
    sid_can_frame_t frame;
    give(false);
    while (!is_pending && sid_node_poll(&node, 64, &pending)) {
        give(true);
    }
    while (!is_pending && sid_hal_can_receive(&frame)) {
        give(sid_node_receive(&node, &frame, &pending));
    }
}

int main(void) {
    if (!power_up()) {
        return 1;
    }
    // PORT: start the timer of the control interrupt here
    while (!sid_node_is_reset_requested(&node)) {
        serve_bus();
        // PORT: the rest of the main loop
        blank_control_interrupt(); // PORT: remove; the timer does this
    }
    return 0; // PORT: reset the processor
}
