#include "drive.h"

#include "board.h"

#define ENCODER_BITS 17
#define UNUSED_BITS (32U - ENCODER_BITS)

drive_t drive;

// ---------------------------------------------------------------- the five functions

void sid_hal_read(sid_sample_t* sample) {
    sample->position_raw = (uint32_t)drive.position_count & drive.axis.encoder_mask;
    sample->torque_pu_q20 = drive.torque_pu_q20;
    if (drive.fault != 0) {
        drive.fault(sample, drive.samples);
    }
    drive.seen_count += sid_unwrap((uint32_t)drive.seen_count, sample->position_raw, UNUSED_BITS);
}

void sid_hal_write_reference(int32_t reference_q8) {
    drive.reference_q8 = reference_q8;
    const int32_t count = drive.is_one_encoder ? drive.seen_count : drive.position_count;
    drive.torque_pu_q20 = sid_loop_step(&drive.loop, reference_q8, count - drive.start_count);
}

uint64_t sid_hal_sample_rate_uHz(void) { return DRIVE_RATE_HZ * (uint64_t)1000000; }
void sid_hal_enter_critical(void) { board_interrupt_off(); }
void sid_hal_exit_critical(void) { board_interrupt_on(); }

// ---------------------------------------------------------------- the control interrupt

void board_timer_interrupt(void) {
    sid_sample_t sample;
    sid_command_t command;
    if (drive.moved != drive.samples) {
        drive.late = drive.late + 1U;
    }
    sid_hal_read(&sample);
    if (drive.node != 0) {
        sid_node_step(drive.node, &sample, &command);
        drive.start_count = sid_unwrap(0, drive.node->run.start_raw, UNUSED_BITS);
    } else {
        sid_identify_step(&drive.session, &sample, &command);
    }
    sid_hal_write_reference(command.reference_q8);
    drive.samples = drive.samples + 1U;
}

// ---------------------------------------------------------------- the main loop

static sid_scaled_t scaled(double x) {
    int32_t exponent = 0;
    while (x < 1073741824.0) {
        x *= 2;
        exponent--;
    }
    return sid_scaled_make((int64_t)(x + 0.5), exponent);
}

static double value(sid_scaled_t s) {
    double x = s.mantissa;
    for (int32_t i = s.exponent; i < 0; i++) {
        x *= 0.5;
    }
    for (int32_t i = 0; i < s.exponent; i++) {
        x *= 2;
    }
    return x;
}

// The controller of the paper: 40 rad/s of position, 40 Hz of speed for the bare motor.
static void set_up_loop(void) {
    const plant_t* const axis = &drive.axis;
    const double speed_rad_s = 40 * 2 * 3.14159265358979323846;
    const double speed_gain_Nms = speed_rad_s * axis->inertia_kgm2;
    sid_loop_config_t config;
    config.position_gain = scaled(40 * axis->sample_s);
    config.speed_gain = scaled(speed_gain_Nms / axis->rated_Nm * axis->count_rad / axis->sample_s);
    config.integral_gain = scaled(axis->sample_s * speed_rad_s / 4);
    config.torque_limit_pu_q20 = 3 << 20;
    config.speed_average = 1;
    (void)sid_loop_init(&drive.loop, &config);
}

void drive_power_up(void) {
    static const uint64_t frequency_uHz[DRIVE_PLAN] = {50000000U, 100000000U};
    static const drive_t nothing;
    board_interrupt_off();
    drive = nothing;
    drive.axis = plant_system_1();
    for (uint32_t i = 0; i < DRIVE_PLAN; i++) {
        drive.plan[i].increment_q64 =
            sid_phase_increment(frequency_uHz[i], sid_hal_sample_rate_uHz());
        drive.plan[i].amplitude_q8 = (int32_t)(1 / drive.axis.count_rad * 256); // 1 rad
    }
    drive.config.plan = drive.plan;
    drive.config.results = drive.results;
    drive.config.plan_length = DRIVE_PLAN;
    drive.config.windows = 2;
    drive.config.position_bits = ENCODER_BITS;
    drive.config.ramp_periods_q8 = 256;
    drive.config.torque_timing = SID_TORQUE_HELD_LAST;
    set_up_loop();
}

bool drive_start(void) {
    static bool is_timer_on;
    const uint32_t position_raw = (uint32_t)drive.position_count & drive.axis.encoder_mask;
    drive.start_count = drive.position_count;
    sid_loop_reset(&drive.loop, 0);
    const bool good = sid_identify_init(&drive.session, &drive.config) &&
                      sid_identify_start(&drive.session, position_raw);
    if (!is_timer_on) {
        is_timer_on = true;
        board_timer_start(DRIVE_RATE_HZ);
    }
    board_interrupt_on();
    return good;
}

void drive_move_axis(void) {
    plant_advance(&drive.axis, drive.torque_pu_q20);
    drive.position_count = plant_count(&drive.axis);
}

sid_state_t drive_main_loop(void) {
    while (drive.samples == drive.moved) {
        board_wait();
    }
    if (drive.stall != 0) {
        drive.stall(drive.moved);
    }
    drive_move_axis();
    drive.moved++;
    return sid_identify_poll(&drive.session, 64);
}

int64_t drive_inertia_e12(const sid_result_t* result) {
    const plant_t* const axis = &drive.axis;
    const double per_count = axis->rated_Nm * axis->sample_s / axis->count_rad;
    return (int64_t)(value(result->inertia) * per_count * axis->sample_s * 1e12 + 0.5);
}

int64_t drive_viscous_e9(const sid_result_t* result) {
    const plant_t* const axis = &drive.axis;
    const double per_count = axis->rated_Nm * axis->sample_s / axis->count_rad;
    return (int64_t)(value(result->viscous) * per_count * 1e9);
}
