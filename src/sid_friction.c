#include "servoid/sid_friction.h"

#include "sid_real.h"

#include <string.h>

static const int32_t LIMIT = (1 << 23) - 1;

void sid_friction_init(sid_friction_t* friction) { memset(friction, 0, sizeof(*friction)); }

void sid_friction_step(sid_friction_t* friction, int32_t speed, int32_t torque_pu_q20) {
    sid_friction_sums_t* const sums = &friction->side[(uint32_t)speed >> 31];
    const uint32_t taken =
        ((speed != 0) ? 1U : 0U) & ((sums->count < SID_FRICTION_COUNT_MAX) ? 1U : 0U);
    const int32_t mask = -(int32_t)taken;
    const int32_t v = sid_clamp(speed, -LIMIT, LIMIT);
    const int32_t torque = sid_clamp(torque_pu_q20, -LIMIT, LIMIT);
    const uint32_t clamped = ((v != speed) ? 1U : 0U) | ((torque != torque_pu_q20) ? 1U : 0U);
    sums->speed += v & mask;
    sums->torque += torque & mask;
    sums->speed_square += (int64_t)(v & mask) * v;
    sums->torque_square += (int64_t)(torque & mask) * torque;
    sums->product += (int64_t)(v & mask) * torque;
    sums->count += taken;
    friction->clamped = sid_count(friction->clamped, taken & clamped);
    friction->dropped = sid_count(friction->dropped, 1U - taken);
}

typedef struct {
    sid_real_t slope;
    sid_real_t offset;
    bool one_speed;
} sid_line_t;

SID_ONCE static sid_real_t real(int64_t x) { return sid_real_make(x, 0); }

static sid_real_t centred(sid_real_t sum, sid_real_t a, sid_real_t b, sid_real_t count) {
    return sid_real_sub(sum, sid_real_div(sid_real_mul(a, b), count));
}

static sid_line_t fit(const sid_friction_sums_t* sums, sid_scaled_t* residual) {
    const sid_real_t n = real(sums->count);
    const sid_real_t sv = real(sums->speed);
    const sid_real_t st = real(sums->torque);
    const sid_real_t vv = centred(real(sums->speed_square), sv, sv, n);
    const sid_real_t vt = centred(real(sums->product), sv, st, n);
    const sid_real_t tt = centred(real(sums->torque_square), st, st, n);
    const sid_real_t floor_vv = sid_real_shift(real(sums->speed_square), -20);
    sid_line_t line;
    line.one_speed = !sid_real_less(floor_vv, vv);
    line.slope = line.one_speed ? real(0) : sid_real_div(vt, vv);
    line.offset = sid_real_div(sid_real_sub(st, sid_real_mul(line.slope, sv)), n);
    const sid_real_t rest = sid_real_sub(tt, sid_real_mul(line.slope, vt));
    sid_real_store(residual, sid_real_shift(sid_real_sqrt(sid_real_div(rest, n)), -20));
    return line;
}

// Q20 sums to rated torque, times 2^halves.
static void store(sid_scaled_t* out, sid_real_t q20, int32_t halves) {
    sid_real_store(out, sid_real_shift(q20, halves - 20));
}

sid_friction_status_t sid_friction_solve(const sid_friction_t* friction,
                                         sid_friction_result_t* out) {
    sid_line_t line[2];
    memset(out, 0, sizeof(*out));
    for (int side = 0; side < 2; side++) {
        line[side] = fit(&friction->side[side], &out->residual[side]);
        store(&out->slope[side], line[side].slope, 0);
        store(&out->offset[side], line[side].offset, 0);
    }
    if ((friction->side[0].count == 0U) && (friction->side[1].count == 0U)) {
        out->status = SID_FRICTION_NOT_RUN;
    } else if ((friction->side[0].count == 0U) || (friction->side[1].count == 0U)) {
        out->status = SID_FRICTION_ONE_DIRECTION;
    } else if (line[0].one_speed || line[1].one_speed) {
        out->status = SID_FRICTION_ONE_SPEED;
    } else {
        store(&out->viscous, sid_real_add(line[0].slope, line[1].slope), -1);
        store(&out->coulomb, sid_real_sub(line[0].offset, line[1].offset), -1);
        store(&out->constant_torque, sid_real_add(line[0].offset, line[1].offset), -1);
        const bool negative = (out->viscous.mantissa < 0) || (out->coulomb.mantissa < 0);
        out->status = negative ? SID_FRICTION_NEGATIVE : SID_FRICTION_OK;
    }
    return out->status;
}
