#include "servoid/sid_inertia.h"

#include "sid_real.h"

#include <string.h>

static sid_real_t two_pi(void) { return sid_real_make(3622009729038561421, -59); }

static sid_real_t dot(sid_real_t a, sid_real_t b, sid_real_t c, sid_real_t d) {
    return sid_real_add(sid_real_mul(a, b), sid_real_mul(c, d));
}

// T H*, |T|^2 and |H|^2 of the phasors T of torque and H of position.
typedef struct {
    sid_real_t re;
    sid_real_t im;
    sid_real_t torque;
    sid_real_t position;
} sid_power_t;

static sid_power_t power_of(const sid_bin_result_t* bin) {
    const sid_real_t tc = sid_real_from_scaled(bin->cosine[0]);
    const sid_real_t ts = sid_real_from_scaled(bin->sine[0]);
    const sid_real_t hc = sid_real_from_scaled(bin->cosine[1]);
    const sid_real_t hs = sid_real_from_scaled(bin->sine[1]);
    sid_power_t out;
    out.re = dot(tc, hc, ts, hs);
    out.im = dot(tc, hs, sid_real_neg(ts), hc);
    out.torque = dot(tc, tc, ts, ts);
    out.position = dot(hc, hc, hs, hs);
    return out;
}

// From the torque that was set to the torque that acted: later by +-1/2 sample, and averaged by the
// hold.
static void act(sid_power_t* power, uint64_t increment, sid_real_t omega,
                sid_torque_timing_t timing) {
    const sid_osc_t osc = sid_osc_at(increment / 2U);
    const sid_real_t c = sid_real_make(osc.cosine_q31, -31);
    const sid_real_t s = sid_real_make(osc.sine_q31, -31);
    const sid_real_t hold = sid_real_div(s, sid_real_shift(omega, -1));
    const sid_real_t turn = (timing == SID_TORQUE_HELD_LAST) ? sid_real_neg(s) : s;
    const sid_real_t re = dot(power->re, c, power->im, turn);
    const sid_real_t im = dot(power->im, c, power->re, sid_real_neg(turn));
    power->re = sid_real_mul(re, hold);
    power->im = sid_real_mul(im, hold);
}

static void store_root(sid_scaled_t* out, sid_real_t square, int32_t shift) {
    sid_real_store(out, sid_real_shift(sid_real_sqrt(square), shift));
}

static sid_real_t mean(sid_scaled_t squares, uint32_t count) {
    return sid_real_div(sid_real_from_scaled(squares), sid_real_make(count, 0));
}

static sid_reason_t reason_of_bin(const sid_bin_t* bin, sid_bin_status_t status) {
    if (bin->position_clamped != 0U) {
        return SID_STROKE_CLIPPED;
    }
    if (bin->torque_clamped != 0U) {
        return SID_OVERFLOW;
    }
    if (status == SID_BIN_ILL_CONDITIONED) {
        return SID_ILL_CONDITIONED;
    }
    return (status == SID_BIN_OK) ? SID_OK : SID_WINDOW_TOO_SHORT;
}

static bool is_below(sid_real_t square, int32_t minimum, int32_t preset, int32_t exponent) {
    const sid_real_t least = sid_real_make((minimum != 0) ? minimum : preset, exponent);
    return sid_real_less(square, sid_real_mul(least, least));
}

static sid_reason_t judge(const sid_inertia_config_t* config, const sid_power_t* power) {
    if (config->saturated_samples != 0U) {
        return SID_SATURATED;
    }
    if (is_below(power->torque, config->torque_min_pu_q20, 1 << 10, 0) ||
        is_below(power->position, config->position_min_q8, 2 << 8, -8)) {
        return SID_NO_EXCITATION;
    }
    return (power->re < 0) ? SID_OK : SID_NEGATIVE_INERTIA;
}

sid_reason_t sid_inertia_solve(const sid_bin_t* bin, const sid_inertia_config_t* config,
                               sid_result_t* result) {
    const uint64_t increment = bin->increment_q64;
    const sid_real_t omega = sid_real_mul(sid_real_make((int64_t)increment, -64), two_pi());
    sid_bin_result_t solved;
    memset(result, 0, sizeof(*result));
    sid_reason_t reason = reason_of_bin(bin, sid_bin_solve(bin, config->method, &solved));
    sid_power_t power = power_of(&solved);
    result->increment_q64 = increment;
    store_root(&result->torque_amplitude, power.torque, -20);
    store_root(&result->position_amplitude, power.position, 0);
    store_root(&result->torque_residual, mean(solved.residual[0], solved.count), -20);
    store_root(&result->position_residual, mean(solved.residual[1], solved.count), 0);
    result->smallest_pivot = solved.smallest_pivot;
    if (config->torque_timing != SID_TORQUE_SAMPLED) {
        act(&power, increment, omega, config->torque_timing);
    }
    if (reason == SID_OK) {
        reason = judge(config, &power);
    }
    if (reason == SID_OK) {
        const sid_real_t scale = sid_real_shift(sid_real_mul(omega, power.position), 20);
        const sid_real_t inertia = sid_real_div(sid_real_neg(power.re), sid_real_mul(scale, omega));
        sid_real_store(&result->inertia, inertia);
        sid_real_store(&result->viscous, sid_real_div(power.im, scale));
        result->windows = 1;
    }
    result->reason = (uint8_t)reason;
    return reason;
}

// ---------------------------------------------------------------- repetition

// Welford: mean += d / n, squares += d * (x - mean).
static void welford(sid_scaled_t* mean, sid_scaled_t* squares, sid_scaled_t x, uint8_t n) {
    const sid_real_t value = sid_real_from_scaled(x);
    const sid_real_t before = sid_real_from_scaled(*mean);
    const sid_real_t step = sid_real_sub(value, before);
    const sid_real_t after = sid_real_add(before, sid_real_div(step, sid_real_make(n, 0)));
    const sid_real_t added = sid_real_mul(step, sid_real_sub(value, after));
    sid_real_store(squares, sid_real_add(sid_real_from_scaled(*squares), added));
    sid_real_store(mean, after);
}

void sid_inertia_combine(sid_result_t* result, const sid_result_t* window) {
    const sid_result_t before = *result;
    *result = *window;
    if (before.windows == 0U) {
        result->windows = 1;
        return;
    }
    result->inertia = before.inertia;
    result->viscous = before.viscous;
    result->inertia_std = before.inertia_std;
    result->viscous_std = before.viscous_std;
    result->windows = (uint8_t)(before.windows + 1U);
    welford(&result->inertia, &result->inertia_std, window->inertia, result->windows);
    welford(&result->viscous, &result->viscous_std, window->viscous, result->windows);
}

static void deviation(sid_scaled_t* squares, uint8_t n) {
    store_root(squares, mean(*squares, (uint32_t)n * (n - 1U)), 0);
}

void sid_inertia_finish(sid_result_t* result) {
    if (result->windows > 1U) {
        deviation(&result->inertia_std, result->windows);
        deviation(&result->viscous_std, result->windows);
        result->std_known = true;
    }
}
