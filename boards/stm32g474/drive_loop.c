#include "drive_loop.h"

#include "power_stage.h"
#include "servoid/servoid.h"

// PORT: the axis and its winding. Here: system 1 of Andoh 2008 (0.116e-4 kg m^2, rated 0.637 N m)
// on 20000 counts a turn, rated current 5 A, 1 ohm, 0.5 mH, 48 V; 400 Hz of current loop.
#define POSITION_GAIN_E6 5000     // 40 rad/s * 125 us
#define SPEED_GAIN_E6 11500       // 2 pi 40 Hz * J / rated torque * rad a count / 125 us
#define INTEGRAL_GAIN_E6 7850     // 2 pi 40 Hz / 4 * 125 us
#define CURRENT_GAIN_Q15 4289     // 2 pi 400 Hz * L * rated current / supply
#define CURRENT_INTEGRAL_Q15 1072 // 2 pi 400 Hz * R * 125 us * rated current / supply
#define TORQUE_LIMIT_PU_Q20 (3 << 20)
#define VOLTAGE_LIMIT_Q35 ((int64_t)POWER_STAGE_MOST_VOLTAGE_Q15 << 20)

static sid_loop_t loop;
static int64_t integral_q35;

static sid_scaled_t millionths(int32_t x) {
    return sid_scaled_div(sid_scaled_make(x, 0), sid_scaled_make(1000000, 0));
}

bool drive_control_init(void) {
    sid_loop_config_t config;
    config.position_gain = millionths(POSITION_GAIN_E6);
    config.speed_gain = millionths(SPEED_GAIN_E6);
    config.integral_gain = millionths(INTEGRAL_GAIN_E6);
    config.torque_limit_pu_q20 = TORQUE_LIMIT_PU_Q20;
    config.speed_average = 1;
    return sid_loop_init(&loop, &config);
}

// The sum takes nothing that leads further beyond the limit.
static int32_t current_control(int32_t error_pu_q20) {
    const int64_t sum = integral_q35 + (int64_t)error_pu_q20 * CURRENT_INTEGRAL_Q15;
    const int64_t wanted = sum + (int64_t)error_pu_q20 * CURRENT_GAIN_Q15;
    const int64_t given = sid_clamp64(wanted, -VOLTAGE_LIMIT_Q35, VOLTAGE_LIMIT_Q35);
    const int64_t stuck = -(int64_t)(((wanted > given) & (error_pu_q20 > 0)) |
                                     ((wanted < given) & (error_pu_q20 < 0)));
    integral_q35 = sum ^ ((sum ^ integral_q35) & stuck);
    return (int32_t)sid_round_shift(given, 20);
}

void drive_control(const drive_in_t* in, drive_out_t* out) {
    if (!in->powered) {
        sid_loop_reset(&loop, in->position_count);
        integral_q35 = 0;
        out->torque_pu_q20 = 0;
        out->voltage_q15 = 0;
        return;
    }
    out->torque_pu_q20 = sid_loop_step(&loop, in->reference_q8, in->position_count);
    out->voltage_q15 = current_control(out->torque_pu_q20 - in->current_pu_q20);
}
