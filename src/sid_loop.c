#include "servoid/sid_loop.h"

#include "sid_real.h"

#include <string.h>

SID_STATIC_ASSERT(sizeof(sid_loop_t) <= 80, loop_fits_its_stated_size);

static bool is_within(sid_scaled_t x, int32_t low_exponent, int32_t high_exponent) {
    const sid_real_t value = sid_real_from_scaled(x);
    return !sid_real_less(value, sid_real_make(1, low_exponent)) &&
           !sid_real_less(sid_real_make(1, high_exponent), value);
}

// Magnitude in Q32 at which gain alone gives the torque limit, times two; at most 2^60.
static int64_t demand_limit(sid_scaled_t speed_gain, int32_t torque_limit) {
    const sid_real_t limit = sid_real_make(torque_limit, -20 + 1 + 32);
    const sid_real_t demand = sid_real_div(limit, sid_real_from_scaled(speed_gain));
    const sid_real_t most = sid_real_make(1, 60);
    return sid_real_to_int(sid_real_less(demand, most) ? demand : most, 0) + 1;
}

bool sid_loop_init(sid_loop_t* loop, const sid_loop_config_t* config) {
    const sid_scaled_t kp =
        sid_scaled_make(config->position_gain.mantissa, config->position_gain.exponent);
    const sid_scaled_t kv =
        sid_scaled_make(config->speed_gain.mantissa, config->speed_gain.exponent);
    const sid_scaled_t ki =
        sid_scaled_make(config->integral_gain.mantissa, config->integral_gain.exponent);
    const uint8_t average = (config->speed_average == 0U) ? 1U : config->speed_average;
    memset(loop, 0, sizeof(*loop));
    if (!is_within(kp, -30, 0) || !is_within(kv, -50, 9) ||
        ((ki.mantissa != 0) && !is_within(ki, -30, 0)) || (average > 4U) ||
        (config->torque_limit_pu_q20 < 1) || (config->torque_limit_pu_q20 > (1 << 23) - 1)) {
        return false;
    }
    loop->position_gain = kp.mantissa;
    loop->position_shift = (uint32_t)(-24 - kp.exponent); // Q8 in, Q32 out
    loop->speed_gain = kv.mantissa;
    loop->speed_shift = (uint32_t)(12 - kv.exponent); // Q32 in, Q20 out
    loop->integral_gain = ki.mantissa;
    loop->integral_shift = (ki.mantissa != 0) ? (uint32_t)(3 - ki.exponent) : 33U;
    loop->torque_limit = config->torque_limit_pu_q20;
    loop->demand_limit_q32 = demand_limit(kv, loop->torque_limit);
    loop->speed_average = average;
    loop->speed_reciprocal_q32 = (((int64_t)1 << 32) + average / 2) / average;
    return true;
}

void sid_loop_reset(sid_loop_t* loop, int32_t position_count) {
    loop->sum_q32 = 0;
    for (int i = 0; i < 4; i++) {
        loop->past[i] = position_count;
    }
}

static int64_t speed_error_q32(sid_loop_t* loop, int32_t reference_q8, int32_t position_count) {
    const int32_t before = loop->past[loop->speed_average - 1];
    const int64_t error_q8 = sid_saturate(reference_q8 - (int64_t)position_count * 256);
    const int64_t moved = sid_clamp(sid_sub_wrap(position_count, before), -(1 << 24), 1 << 24);
    loop->past[3] = loop->past[2];
    loop->past[2] = loop->past[1];
    loop->past[1] = loop->past[0];
    loop->past[0] = position_count;
    return sid_round_shift(error_q8 * loop->position_gain, loop->position_shift) -
           moved * loop->speed_reciprocal_q32;
}

// Once in the code, twice a sample.
SID_ONCE static int64_t scale(int64_t x, int32_t gain, uint32_t shift) {
    return sid_mul_shift(x, gain, shift);
}

int32_t sid_loop_step(sid_loop_t* loop, int32_t reference_q8, int32_t position_count) {
    const int32_t limit = loop->torque_limit;
    const int64_t most = loop->demand_limit_q32;
    const int64_t error = speed_error_q32(loop, reference_q8, position_count);
    // 8 times, so that the shift is in the range of sid_mul_shift even at h = Ti.
    const int64_t added = scale(error * 8, loop->integral_gain, loop->integral_shift);
    const int64_t sum = sid_clamp64(loop->sum_q32 + added, -most, most);
    const int64_t demand = sid_clamp64(error + sum, -most, most);
    const int32_t torque = sid_saturate(scale(demand, loop->speed_gain, loop->speed_shift));
    const int32_t out = sid_clamp(torque, -limit, limit);
    const int32_t excess = torque - out;
    // Integrates unless that would lead further beyond the limit: excess and added of the same
    // sign.
    const int64_t stuck = -(int64_t)(((excess > 0) & (added > 0)) | ((excess < 0) & (added < 0)));
    loop->sum_q32 = sum ^ ((sum ^ loop->sum_q32) & stuck);
    loop->saturated_samples = sid_count(loop->saturated_samples, (excess != 0) ? 1U : 0U);
    return out;
}
