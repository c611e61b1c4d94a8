#include "board.h"
#include "replay.h"

static const int32_t corner[] = {0,        1,        -1,      1 << 20,   -(1 << 20), 8388607,
                                 -8388607, -8388608, 8388608, INT32_MAX, INT32_MIN};
#define CORNERS (sizeof(corner) / sizeof(corner[0]))

static int32_t random_corner(void) { return corner[replay_random() % CORNERS]; }

static void print_solution(const sid_bin_t* bin, sid_bin_method_t method) {
    sid_bin_result_t result;
    replay_print("status", sid_bin_solve(bin, method, &result));
    for (int channel = 0; channel < 2; channel++) {
        replay_print_scaled("cos", result.cosine[channel]);
        replay_print_scaled("sin", result.sine[channel]);
        replay_print_scaled("residual", result.residual[channel]);
    }
    replay_print_scaled("pivot", result.smallest_pivot);
    replay_print_scaled("product", result.product_mean);
    replay_end_line();
}

// A window at the ends of the range: kind 0 full scale, 1 corners, 2 sine with noise.
static void replay_bin(uint32_t count, uint64_t increment, uint32_t kind) {
    static sid_bin_t bin;
    board_print("bin\n");
    replay_print("started", sid_bin_start(&bin, increment, increment * 5U, count) ? 1 : 0);
    for (uint32_t i = 0; i < count + 3U; i++) {
        const int32_t sine = replay_sine((uint32_t)(increment >> 32) * i);
        int32_t torque = 8388607;
        int32_t position = -8388607;
        if (kind == 1U) {
            torque = random_corner();
            position = random_corner();
        }
        if (kind == 2U) {
            torque = -9 * sine + (int32_t)(replay_random() >> 20);
            position = 3 * sine + (int32_t)i;
        }
        sid_bin_step(&bin, torque, position);
    }
    while (!sid_bin_gram_advance(&bin, 1000)) {
    }
    replay_print_bin(&bin);
    for (int method = SID_BIN_CUBIC; method <= SID_BIN_PLAIN_DFT; method++) {
        print_solution(&bin, (sid_bin_method_t)method);
    }
}

static void replay_oscillator(void) {
    replay_digest_t digest = {0};
    uint64_t phase = 0;
    for (uint32_t i = 0; i < 20000U; i++) {
        const sid_osc_t osc = sid_osc_at(phase);
        replay_digest(&digest, (uint32_t)osc.sine_q31);
        replay_digest(&digest, (uint32_t)osc.cosine_q31);
        phase += ((uint64_t)replay_random() << 32) | replay_random();
    }
    board_print("oscillator");
    replay_print("", (int64_t)digest.sum);
    replay_print("increment", (int64_t)sid_phase_increment(123456789U, 8000000001U));
    replay_end_line();
}

static void replay_loop(sid_scaled_t speed_gain, uint8_t average) {
    static sid_loop_t loop;
    replay_digest_t digest = {0};
    sid_loop_config_t config;
    config.position_gain = sid_scaled_make(5, -10);
    config.speed_gain = speed_gain;
    config.integral_gain = sid_scaled_make(1, -7);
    config.torque_limit_pu_q20 = 3 << 20;
    config.speed_average = average;
    board_print("loop");
    replay_print("good", sid_loop_init(&loop, &config) ? 1 : 0);
    sid_loop_reset(&loop, -77);
    for (uint32_t i = 0; i < 5000U; i++) {
        const bool wild = replay_random() % 50U == 0U;
        const int32_t reference = wild ? random_corner() : replay_sine(i << 21) * 16;
        const int32_t position = wild ? random_corner() : replay_sine((i << 21) - 999999U) / 20;
        replay_digest(&digest, (uint32_t)sid_loop_step(&loop, reference, position));
    }
    replay_print("torques", (int64_t)digest.sum);
    replay_print("sum", loop.sum_q32);
    replay_print("saturated", loop.saturated_samples);
    replay_end_line();
}

static void replay_friction(bool wild) {
    static sid_friction_t friction;
    sid_friction_result_t result;
    sid_friction_init(&friction);
    for (uint32_t i = 0; i < 9000U; i++) {
        const int32_t speed = wild ? random_corner() : replay_sine(i << 20);
        const int32_t torque =
            wild ? random_corner() : 7 * speed + ((speed < 0) ? -5000 : 6000) + (int32_t)(i & 15U);
        sid_friction_step(&friction, speed, torque);
    }
    board_print("friction");
    replay_print("status", sid_friction_solve(&friction, &result));
    replay_print_scaled("D", result.viscous);
    replay_print_scaled("Tc", result.coulomb);
    replay_print_scaled("w", result.constant_torque);
    for (int side = 0; side < 2; side++) {
        replay_print_scaled("slope", result.slope[side]);
        replay_print_scaled("offset", result.offset[side]);
        replay_print_scaled("residual", result.residual[side]);
    }
    replay_print("clamped", friction.clamped);
    replay_print("dropped", friction.dropped);
    replay_end_line();
}

static void replay_scaled(void) {
    replay_digest_t digest = {0};
    sid_scaled_t a = sid_scaled_make(3, 0);
    for (uint32_t i = 0; i < 3000U; i++) {
        const int64_t word = (int64_t)(((uint64_t)replay_random() << 32) | replay_random());
        const sid_scaled_t b = sid_scaled_make(word >> (replay_random() % 63U), -31);
        const sid_scaled_t c = (i % 2U == 0U) ? sid_scaled_mul(a, b) : sid_scaled_div(a, b);
        replay_digest(&digest, (uint32_t)c.mantissa);
        replay_digest(&digest, (uint32_t)(int32_t)c.exponent);
        replay_digest(&digest, (uint32_t)sid_scaled_to_fixed(c, (int32_t)(i % 40U)));
        a = (i % 7U == 0U) ? b : c;
    }
    board_print("scaled");
    replay_print("", (int64_t)digest.sum);
    replay_end_line();
}

void replay_modules(void) {
    replay_bin(65535, (uint64_t)1 << 52, 0);
    replay_bin(65535, sid_phase_increment(1, 8000), 1);
    replay_bin(8, (uint64_t)1 << 61, 1);
    replay_bin(3000, sid_phase_increment(777, 80000), 2);
    replay_bin(200, sid_phase_increment(29, 4000), 2);
    replay_oscillator();
    replay_loop(sid_scaled_make(20000, -20), 1);
    replay_loop(sid_scaled_make(1, 9), 4);
    replay_loop(sid_scaled_make(1, -50), 3);
    replay_friction(false);
    replay_friction(true);
    replay_scaled();
}
