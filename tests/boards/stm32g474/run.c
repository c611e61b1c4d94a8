// The whole port on a simulated motor: a master on the bus starts a session, the control interrupt
// moves the axis through the registers, and the inertia comes out. Then every fault: the outputs
// are off in the sample that sees it, and the run ends.
#include "board.h"
#include "clock.h"
#include "fake.h"
#include "power_stage.h"
#include "servo.h"
#include "servoid/servoid.h"

#include <string.h>

#define TIM1_SR 0x40012C10U
#define TIM1_CCR1 0x40012C34U
#define TIM1_CCR2 0x40012C38U
#define TIM1_BDTR 0x40012C44U
#define TIM2_CNT 0x40000024U
#define ADC1_JDR1 0x50000080U
#define ADC2_JDR1 0x50000180U
#define CYCCNT 0xE0001004U
#define IWDG_KR 0x40003000U
#define RCC 0x40021000U
#define MASTER 127U
#define NODE 1U

// ---------------------------------------------------------------- the motor

#define STEPS 25
#define SUPPLY_V 48.0
#define RATED_A 5.0
#define COUNTS_PER_A (512.0 / RATED_A)
#define COUNT_RAD (2 * 3.14159265358979323846 / 20000)
static const double sample_s = 125e-6, ohm = 1, henry = 0.5e-3, Nm_per_A = 0.637 / RATED_A;
static const double inertia_kgm2 = 0.116e-4, viscous_Nms = 0.75e-4, coulomb_Nm = 6.6e-3;

static struct {
    double current_A, speed_rad_s, angle_rad;
    int32_t ccr1, ccr2; // what the last update event took over
    uint32_t first_count;
    int32_t extra_a; // of the sensor at leg A, counts
    uint32_t cycles; // between triggers
} motor;

static double braked(double speed, double friction) {
    if (speed > friction) {
        return speed - friction;
    }
    return (speed < -friction) ? speed + friction : 0;
}

static bool is_on(void) { return fake_bits(TIM1_BDTR, 15, 15) == 1U; }

static void move_motor(void) {
    const double voltage = SUPPLY_V * (motor.ccr1 - motor.ccr2) / 2125;
    const double step_s = sample_s / STEPS;
    for (int i = 0; i < STEPS; i++) {
        const double emf = Nm_per_A * motor.speed_rad_s;
        motor.current_A += step_s / henry * (voltage - emf - ohm * motor.current_A);
        if (!is_on()) {
            motor.current_A = 0; // gone through the diodes, at once
        }
        const double torque = Nm_per_A * motor.current_A - viscous_Nms * motor.speed_rad_s;
        const double next = braked(motor.speed_rad_s + step_s / inertia_kgm2 * torque,
                                   step_s / inertia_kgm2 * coulomb_Nm);
        motor.angle_rad += step_s * 0.5 * (motor.speed_rad_s + next);
        motor.speed_rad_s = next;
    }
}

static int32_t rounded_down(double x) {
    const int32_t toward_zero = (int32_t)x;
    return toward_zero - ((x < toward_zero) ? 1 : 0);
}

static void convert(void) {
    const int32_t current = rounded_down(motor.current_A * COUNTS_PER_A + 0.5);
    fake_set(ADC1_JDR1, (uint32_t)(2060 + current + motor.extra_a));
    fake_set(ADC2_JDR1, (uint32_t)(2035 - current));
    fake_set(TIM2_CNT, motor.first_count + (uint32_t)rounded_down(motor.angle_rad / COUNT_RAD));
    fake_set(CYCCNT, fake_get(CYCCNT) + motor.cycles);
}

// ---------------------------------------------------------------- the bus

static struct {
    uint32_t answer;    // first byte of the last SDO answer
    uint32_t value;     // and its number
    uint32_t rows;      // of telemetry
    uint32_t next_tick; // of the row to come
    uint32_t gaps;
    uint32_t heartbeats;
} bus;

static void hear(void) {
    uint32_t element[FAKE_ELEMENT];
    sid_can_frame_t frame;
    while (fake_can_leave(element)) {
        fake_decode(element, &frame);
        if (frame.id == SID_ID_ANSWER + NODE) {
            bus.answer = frame.data[0];
            bus.value = sid_get_u32(&frame.data[4]);
        } else if (frame.id == SID_ID_HEARTBEAT + NODE) {
            bus.heartbeats++;
        } else if ((frame.id == SID_ID_TELEMETRY + NODE) && (frame.data[0] == SID_FRAME_SAMPLES)) {
            const uint32_t tick = sid_get_u32(&frame.data[4]);
            bus.gaps += ((bus.rows != 0U) && (tick != bus.next_tick)) ? 1U : 0U;
            bus.rows += frame.data[1];
            bus.next_tick = tick + frame.data[1];
        } else {
            // a description, progress
        }
    }
}

static void give(const sid_can_frame_t* frame) {
    uint32_t element[FAKE_ELEMENT];
    fake_encode(frame, element);
    expect(fake_can_arrive(element), "Rx FIFO has room", frame->id);
}

static void give_heartbeat(void) {
    const sid_can_frame_t frame = {SID_ID_HEARTBEAT + MASTER, 1, false, {5}};
    give(&frame);
}

static void transfer(uint32_t command, uint16_t index, uint8_t sub, uint32_t value) {
    sid_can_frame_t frame = {SID_ID_REQUEST + NODE, 8, false, {0}};
    frame.data[0] = (uint8_t)command;
    sid_put_u16(&frame.data[1], index);
    frame.data[3] = sub;
    sid_put_u32(&frame.data[4], value);
    bus.answer = 0;
    give(&frame);
    for (int i = 0; i < 4; i++) {
        servo_serve();
        hear();
    }
}

static void write(uint16_t index, uint8_t sub, uint32_t value, uint32_t bytes) {
    transfer(0x23U | ((4U - bytes) << 2), index, sub, value);
    expect(bus.answer == 0x60U, "write accepted", index * 256 + sub);
}

static uint32_t read(uint16_t index, uint8_t sub) {
    transfer(0x40U, index, sub, 0);
    expect((bus.answer & 0xE3U) == 0x43U, "read answered", index * 256 + sub);
    return bus.value;
}

static uint32_t state(void) { return read(0x2A02, 1) & 0xFFU; }
static uint32_t reason(void) { return read(0x2A02, 2) & 0xFFU; }

// ---------------------------------------------------------------- time

static void sample(void) {
    motor.ccr1 = (int32_t)fake_get(TIM1_CCR1);
    motor.ccr2 = (int32_t)fake_get(TIM1_CCR2);
    convert();
    ADC1_2_IRQHandler();
    move_motor();
}

static void run_samples(uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        sample();
        servo_serve();
        hear();
        if (i % 200U == 0U) {
            give_heartbeat();
        }
    }
}

static void start(uint32_t run) {
    give_heartbeat();
    write(0x2A01, 1, 77, 4);         // claim
    write(0x2A01, 6, 1, 1);          // telemetry
    write(0x2A03, 1, 1, 1);          // one leg
    write(0x2A03, 2, 2, 1);          // of two windows
    write(0x2A05, 1, 100000000, 4);  // 100 Hz
    write(0x2A06, 1, 3183 * 256, 4); // 1 rad of reference
    write(0x2A01, 2, SID_RUN_IDENTIFY, 1);
    write(0x2A01, 4, run, 4);
}

// From the reset on; the encoder is about to roll over.
static bool power_up(void) {
    memset(&motor, 0, sizeof(motor));
    memset(&bus, 0, sizeof(bus));
    fake_reset();
    motor.cycles = 21250;
    motor.first_count = 0xFFFFFFF0U;
    return clock_init() && watchdog_init() && servo_init() && power_stage_init();
}

static void say(const char* name, int64_t value) {
    board_print(name);
    board_print_int(value);
}

// ---------------------------------------------------------------- what is tested

static void wake_up(void) {
    expect(power_up(), "power-up", 0);
    power_stage_start();
    for (int i = 0; i < 1023; i++) {
        sample();
        servo_serve();
        expect(!is_on(), "off while the zero is measured", i);
    }
    hear();
    expect(bus.heartbeats == 0U, "silent until then", bus.heartbeats);
    run_samples(100);
    expect(bus.heartbeats == 1U, "boot-up after it", bus.heartbeats);
    expect(!is_on(), "off without a run", 0);
    expect(servo_fault() == SERVO_OK, "no fault", servo_fault());
}

// J of the result in 1e-12 kg m^2: mantissa and exponent are read over the bus.
static int64_t inertia_e12(void) {
    const double per_count = 0.637 * sample_s * sample_s / COUNT_RAD;
    double x = (int32_t)read(0x2A10, 4);
    int32_t exponent = (int16_t)(read(0x2A10, 5) & 0xFFFFU);
    for (; exponent < 0; exponent++) {
        x *= 0.5;
    }
    for (; exponent > 0; exponent--) {
        x *= 2;
    }
    return (int64_t)(x * per_count * 1e12 + 0.5);
}

static void find_inertia(void) {
    wake_up();
    const uint32_t before = bus.rows;
    start(1);
    sample();
    expect(is_on(), "on in the first sample of a run", 0);
    uint32_t samples = 1;
    while ((state() < SID_STATE_DONE) && (samples < 20000U)) {
        run_samples(1);
        samples++;
        if (samples % 200U == 0U) {
            give_heartbeat();
        }
    }
    expect(reason() == SID_OK, "reason", reason());
    expect(bus.gaps == 0U, "gaps of telemetry", bus.gaps);
    expect(bus.rows - before + 5U > samples, "rows of telemetry", bus.rows);
    expect(servo_missed() == 0U, "missed triggers", servo_missed());
    const int64_t found_e12 = inertia_e12();
    const int64_t error_ppm = (found_e12 - 11600000) * 1000000 / 11600000;
    say("100 Hz through the registers: J ", found_e12);
    say("e-12 kg m^2, error ", error_ppm);
    say(" ppm, samples ", samples);
    board_print("\n");
    expect((error_ppm > -15000) && (error_ppm < 15000), "inertia, ppm", error_ppm);
    run_samples(3900);
    expect(is_on(), "holds the axis after a run", 0);
    run_samples(200);
    expect(!is_on(), "off half a second after a run", 0);
    expect(fake_get(TIM1_CCR1) - fake_get(TIM1_CCR2) + 1U <= 2U, "no voltage", 0);
}

static void begin_and_run(void) {
    wake_up();
    start(1);
    run_samples(300);
    expect(is_on(), "on in a run", 0);
    expect(servo_fault() == SERVO_OK, "no fault before it", servo_fault());
}

// The sample that sees it turns the outputs off, the run ends, and no other one turns them on.
static void expect_off(servo_fault_t fault, const char* name) {
    sample();
    expect(!is_on(), name, 0);
    expect(servo_fault() == fault, name, servo_fault());
    run_samples(100);
    expect(state() == SID_STATE_ABORTED, "run aborted", state());
    expect(reason() == SID_ABORTED_BY_USER, "reason", reason());
    write(0x2A01, 4, 2, 4);
    run_samples(100);
    expect(!is_on(), "no power in the next run", 0);
    expect(state() == SID_STATE_ABORTED, "which is aborted too", state());
    board_print(name);
    board_print(": off in the same sample, run aborted\n");
}

static void test_faults(void) {
    begin_and_run();
    fake_set(TIM1_SR, fake_get(TIM1_SR) | 0x80U); // as the hardware does it
    fake_set(TIM1_BDTR, fake_get(TIM1_BDTR) & ~(uint32_t)0x8000U);
    expect_off(SERVO_BREAK, "break");
    begin_and_run();
    motor.current_A = 19;
    expect_off(SERVO_OVERCURRENT, "overcurrent");
    begin_and_run();
    motor.extra_a = 150;
    expect_off(SERVO_SENSOR, "sensor");
    begin_and_run();
    motor.cycles = 42500;
    sample();
    motor.cycles = 21250;
    expect(servo_missed() == 1U, "missed triggers", servo_missed());
    expect_off(SERVO_OVERRUN, "overrun");
}

static void test_zero(void) {
    expect(power_up(), "power-up", 0);
    motor.extra_a = 300;
    power_stage_start();
    for (int i = 0; i < 1100; i++) {
        sample();
    }
    expect(servo_fault() == SERVO_SENSOR, "zero far off", servo_fault());
}

// A break while there is no run is the driver's that wakes up late.
static void test_early_break(void) {
    wake_up();
    fake_set(TIM1_SR, 0x80U);
    run_samples(10);
    start(1);
    run_samples(10);
    expect(is_on() && (servo_fault() == SERVO_OK), "early break forgiven", servo_fault());
}

static void test_watchdog(void) {
    begin_and_run();
    fake_set(IWDG_KR, 0);
    for (int i = 0; i < 1000; i++) {
        sample(); // the main loop is dead; so is the master's heartbeat, for the node
    }
    const int32_t rest = (int32_t)fake_get(TIM2_CNT);
    sample();
    const int32_t moved = (int32_t)fake_get(TIM2_CNT) - rest;
    expect((moved >= -1) && (moved <= 1), "held before the watchdog bites", moved);
    expect(fake_get(IWDG_KR) == 0U, "a dead main loop feeds nobody", 0);
    servo_serve();
    expect(fake_get(IWDG_KR) == 0xAAAAU, "fed by the main loop", 0);
    fake_set(IWDG_KR, 0);
    servo_serve();
    expect(fake_get(IWDG_KR) == 0U, "not without interrupts", 0);
}

static void test_reset(void) {
    begin_and_run();
    const sid_can_frame_t reset = {SID_ID_NMT, 2, false, {0x81, NODE}};
    give(&reset);
    servo_serve();
    expect(is_on() && !servo_may_reset(), "stops the axis first", 0);
    run_samples(4200);
    expect(!is_on() && servo_may_reset(), "then resets", 0);
}

int main(void) {
    find_inertia();
    test_faults();
    test_zero();
    test_early_break();
    test_watchdog();
    test_reset();
    return (fake_failures == 0) ? 0 : 1;
}
