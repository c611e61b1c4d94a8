#include "servo.h"

#include "clock.h"
#include "drive_loop.h"
#include "fdcan.h"
#include "power_stage.h"
#include "servoid/servoid.h"
#include "stm32g474.h"

#include <string.h>

// PORT: the sensors, 2048 counts of 12 bits for four times the rated current.
#define CURRENT_PU_Q20_PER_COUNT 2048
#define OVERCURRENT_PU_Q20 (7 << 19) // PORT: 3.5 times rated
#define ZERO_COUNT 2048
#define ZERO_ERROR_COUNT 200 // PORT
#define SUM_ERROR_COUNT 100  // PORT: what goes in at A comes out at B
#define ZERO_SAMPLES 1024    // of the zero, with the power off; 128 ms
#define ZERO_SHIFT 10

#define PER_TRIGGER_Q32 (((uint64_t)1 << 32) / POWER_STAGE_CYCLES + 1U) // for a division

#define PLAN 32U
#define ROWS 1024U       // 128 ms of telemetry
#define REFERENCES 2048U // 256 ms of a streamed move
#define NODE_ID 1U       // PORT

static sid_node_t node;
static sid_node_config_t config;
static sid_frequency_t plan[PLAN];
static sid_result_t results[PLAN];
static sid_row_t rows[ROWS];
static int32_t references[REFERENCES];

// What the bus did not take waits here, and keeps its place.
static sid_can_frame_t pending;
static bool is_pending;

// What the interrupt keeps, but for `fed`; the main loop reads single words of it.
static struct {
    int32_t zero_a; // sums until there are ZERO_SAMPLES of them, then the mean
    int32_t zero_b;
    int32_t zero_samples;
    int32_t sum_count; // of both sensors
    int32_t current_pu_q20;
    uint32_t position_raw;
    uint32_t origin_raw; // where the power came on
    uint32_t cycles;     // at the last interrupt
    uint32_t hold_samples;
    volatile uint32_t fault; // servo_fault_t
    volatile uint32_t missed;
    volatile uint32_t samples;
    uint32_t fed; // samples when the main loop last fed the watchdog
    volatile bool ready;
    volatile bool powered;
} servo;

// ---------------------------------------------------------------- the functions of sid_hal.h

void sid_hal_read(sid_sample_t* sample) {
    const power_stage_sample_t now = power_stage_read();
    servo.position_raw = power_stage_encoder();
    if (servo.ready) {
        const int32_t a = now.current_a - servo.zero_a;
        const int32_t b = now.current_b - servo.zero_b;
        servo.sum_count = a + b;
        servo.current_pu_q20 = (a - b) * (CURRENT_PU_Q20_PER_COUNT / 2);
    } else {
        servo.zero_a += now.current_a;
        servo.zero_b += now.current_b;
    }
    sample->position_raw = servo.position_raw;
    sample->torque_pu_q20 = servo.current_pu_q20;
}

void sid_hal_write_reference(int32_t reference_q8) {
    drive_in_t in;
    drive_out_t out;
    // The zero of the reference changes with a run; that of the loop must not, or it sees a speed.
    const int32_t zero_count = (int32_t)(node.run.start_raw - servo.origin_raw);
    in.reference_q8 = sid_saturate(reference_q8 + (int64_t)zero_count * 256);
    in.position_count = (int32_t)(servo.position_raw - servo.origin_raw);
    in.current_pu_q20 = servo.current_pu_q20;
    in.powered = servo.powered;
    drive_control(&in, &out);
    power_stage_set_voltage(out.voltage_q15);
}

uint64_t sid_hal_sample_rate_uHz(void) { return POWER_STAGE_RATE_HZ * (uint64_t)1000000; }

// The main loop does not preempt the interrupt, so nothing here needs them; a program may.
void sid_hal_enter_critical(void) { cortex_m4_set_basepri(POWER_STAGE_IRQ_PRIORITY); }
void sid_hal_exit_critical(void) { cortex_m4_set_basepri(0); }

bool sid_hal_can_receive(sid_can_frame_t* frame) { return fdcan_receive(frame); }
bool sid_hal_can_send(const sid_can_frame_t* frame) { return fdcan_send(frame); }

// ---------------------------------------------------------------- the control interrupt

static bool is_run_on(void) {
    return sid_node_is_running(&node) && (node.kind != (uint8_t)SID_RUN_HOLD);
}

static void latch(bool is_faulty, servo_fault_t fault) {
    if (is_faulty && (servo.fault == (uint32_t)SERVO_OK)) {
        servo.fault = (uint32_t)fault;
    }
}

static bool is_beyond(int32_t x, int32_t limit) { return (x > limit) || (x < -limit); }

static void finish_zero(void) {
    servo.zero_a >>= ZERO_SHIFT;
    servo.zero_b >>= ZERO_SHIFT;
    latch(is_beyond(servo.zero_a - ZERO_COUNT, ZERO_ERROR_COUNT) ||
              is_beyond(servo.zero_b - ZERO_COUNT, ZERO_ERROR_COUNT),
          SERVO_SENSOR);
    servo.ready = true;
}

// Triggers since the last interrupt: the core's clock is the timer's, so the count is exact. One
// whose interrupt was still pending at the next is gone without any other trace.
static uint32_t count_triggers(void) {
    const uint32_t now = *DWT_CYCCNT;
    const uint32_t elapsed = now - servo.cycles;
    servo.cycles = now;
    return (uint32_t)((((uint64_t)elapsed + POWER_STAGE_CYCLES / 2U) * PER_TRIGGER_Q32) >> 32);
}

static void watch(bool is_on) {
    const uint32_t triggers = count_triggers();
    if ((triggers > 1U) && (servo.samples != 0U)) {
        servo.missed += triggers - 1U;
    }
    latch((triggers != 1U) && is_on, SERVO_OVERRUN);
    latch(is_beyond(servo.current_pu_q20, OVERCURRENT_PU_Q20), SERVO_OVERCURRENT);
    latch(is_beyond(servo.sum_count, SUM_ERROR_COUNT), SERVO_SENSOR);
    if (is_on || servo.powered) {
        latch(power_stage_is_broken(), SERVO_BREAK);
    } else {
        power_stage_forgive_break(); // a driver that wakes up later than we do
    }
}

static void switch_power(bool is_on) {
    if (is_on) {
        servo.hold_samples = SERVO_HOLD_MS * POWER_STAGE_RATE_HZ / 1000U;
    } else if (servo.hold_samples != 0U) {
        servo.hold_samples--;
    } else {
        // stays off
    }
    if (!servo.powered) {
        servo.origin_raw = servo.position_raw;
    }
    servo.powered = (servo.hold_samples != 0U) && (servo.fault == (uint32_t)SERVO_OK);
    if (servo.powered) {
        power_stage_on();
    } else {
        power_stage_off();
    }
}

void ADC1_2_IRQHandler(void) {
    sid_sample_t sample;
    sid_command_t command;
    sid_hal_read(&sample);
    if (!servo.ready && (++servo.zero_samples == ZERO_SAMPLES)) {
        finish_zero();
    }
    sid_node_step(&node, &sample, &command);
    const bool is_on = is_run_on();
    watch(is_on);
    switch_power(is_on);
    sid_hal_write_reference(command.reference_q8);
    servo.samples = servo.samples + 1U;
}

// ---------------------------------------------------------------- configuration

static sid_scaled_t quotient(int64_t a, int64_t b) {
    return sid_scaled_div(sid_scaled_make(a, 0), sid_scaled_make(b, 0));
}

static void describe_axis(void) { // PORT: the axis
    config.axis.sample_rate_uHz = sid_hal_sample_rate_uHz();
    config.axis.rated_torque = quotient(637, 1000);                   // N m
    config.axis.count = quotient(62831853072, 20000 * 10000000000LL); // rad
    config.axis.encoder_increments = 20000;
    config.axis.encoder_revolutions = 1;
}

bool servo_init(void) {
    memset(&servo, 0, sizeof(servo));
    is_pending = false;
    describe_axis();
    config.identify.results = results;
    config.identify.position_bits = 32;
    config.identify.stroke_limit_count = 20000;    // PORT: a turn
    config.identify.step_limit_count = 1000;       // PORT: 2500 rad/s
    config.identify.torque_limit_pu_q20 = 3 << 20; // PORT
    config.identify.torque_timing = SID_TORQUE_SAMPLED;
    config.plan = plan;
    config.plan_capacity = PLAN;
    config.node_id = NODE_ID;
    config.master_id = 127;         // PORT
    config.master_timeout_ms = 100; // PORT: less than WATCHDOG_MS
    config.heartbeat_ms = 100;      // PORT
    config.rows = rows;
    config.row_count = ROWS;
    config.references = references;
    config.reference_count = REFERENCES;
    return drive_control_init() && sid_node_init(&node, &config) && fdcan_init(NODE_ID);
}

// ---------------------------------------------------------------- the main loop

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

// The node ends its run as it does when a master says stop.
static void stop_node(void) {
    const sid_can_frame_t stop = {SID_ID_NMT, 2, false, {0x02, NODE_ID}};
    sid_can_frame_t answer;
    (void)sid_node_receive(&node, &stop, &answer);
}

static void feed_watchdog(void) {
    if (servo.samples != servo.fed) {
        servo.fed = servo.samples;
        watchdog_kick();
    }
}

void servo_serve(void) {
    feed_watchdog();
    if (!servo.ready) {
        return; // nobody can start a run before the zero of the current is known
    }
    if ((servo.fault != (uint32_t)SERVO_OK) && sid_node_is_running(&node)) {
        stop_node();
    }
    serve_bus();
}

bool servo_may_reset(void) { return sid_node_is_reset_requested(&node) && !servo.powered; }
servo_fault_t servo_fault(void) { return (servo_fault_t)servo.fault; }
uint32_t servo_missed(void) { return servo.missed; }
