#include "servoid/sid_excite.h"

#include <string.h>

SID_STATIC_ASSERT(sizeof(sid_excite_t) <= 72, excite_fits_its_stated_size);

bool sid_excite_init(sid_excite_t* excite, const sid_excite_config_t* config) {
    const uint32_t bits = config->position_bits;
    const uint32_t shift = config->position_shift;
    memset(excite, 0, sizeof(*excite));
    excite->tick = SID_TICK_PARKED;
    excite->trip = INT32_MIN;
    excite->stuck_limit = INT32_MAX;
    excite->leg_ticks = 1;
    if ((bits < 1U) || (bits > 32U) || (shift > 8U)) {
        return false;
    }
    excite->unused_bits = 32U - bits;
    excite->position_shift = shift;
    excite->step_limit = config->step_limit;
    excite->stroke_limit = config->stroke_limit;
    excite->torque_limit = config->torque_limit;
    return (config->step_limit >= 1) && ((config->step_limit >> shift) <= (1 << 22)) &&
           (config->torque_limit >= 1) && (config->torque_limit <= (1 << 23) - 1) &&
           (config->stroke_limit >= 1) &&
           (config->stroke_limit <= (1 << 23) - 1 - (config->step_limit >> shift));
}

void sid_excite_rebase(sid_excite_t* excite, uint32_t position_raw) {
    excite->trip = INT32_MIN; // frozen: the interrupt leaves the rest alone
    SID_FENCE();
    excite->unwrapped = position_raw;
    // Half a session count lower, so that the shift rounds.
    excite->origin = position_raw - (((uint32_t)1 << excite->position_shift) >> 1);
    excite->impulse = 0;
    SID_FENCE();
    excite->trip = 0;
}

bool sid_excite_begin(sid_excite_t* excite, const sid_leg_t* leg) {
    if ((leg->increment_q64 == 0U) || (leg->increment_q64 >= ((uint64_t)1 << 63)) ||
        (leg->leg_ticks < 1U) || (leg->leg_ticks > ((uint32_t)1 << 30)) ||
        (leg->stuck_limit < 1U) || (leg->stuck_limit > ((uint32_t)1 << 30)) ||
        (leg->amplitude_q8 < 0) || (leg->amplitude_q8 >= (1 << 30))) {
        return false;
    }
    excite->tick = SID_TICK_PARKED;
    SID_FENCE();
    excite->gain_q30 = 0;
    excite->increment_q64 = leg->increment_q64;
    excite->amplitude_q9 = leg->amplitude_q8 * 2;
    excite->leg_ticks = leg->leg_ticks;
    // The interrupt adds ~step, one less, on the way up.
    excite->gain_step_q30 = (leg->ramp_ticks < 2U)
                                ? -(1 << 30)
                                : -(int32_t)(((uint32_t)1 << 30) / leg->ramp_ticks + 1U);
    excite->impulse = 0;
    excite->stuck_limit = leg->stuck_limit;
    SID_FENCE();
    excite->tick = 0;
    return true;
}

void sid_excite_finish(sid_excite_t* excite) { excite->leg_ticks = 1; }

void sid_excite_park(sid_excite_t* excite) {
    excite->tick = SID_TICK_PARKED;
    excite->stuck_limit = INT32_MAX;
    excite->gain_q30 = 0;
}

void sid_excite_abort(sid_excite_t* excite) { excite->torque_limit = -1; }

bool sid_excite_is_still(const sid_excite_t* excite) {
    return (excite->trip < 0) || ((excite->tick >= excite->leg_ticks) && (excite->gain_q30 == 0));
}

sid_trip_t sid_excite_trip(const sid_excite_t* excite) {
    const int32_t position =
        (int32_t)(excite->unwrapped - excite->origin) >> excite->position_shift;
    if (excite->trip >= 0) {
        return SID_TRIP_NONE;
    }
    if ((excite->trip & 1) != 0) {
        return SID_TRIP_TORQUE;
    }
    if ((int32_t)(excite->stuck_limit - excite->impulse) < 0) {
        return SID_TRIP_STUCK;
    }
    return (sid_magnitude(position) > excite->stroke_limit) ? SID_TRIP_STROKE : SID_TRIP_JUMP;
}

void sid_excite_step(sid_excite_t* excite, const sid_sample_t* in, sid_command_t* out) {
    sid_tick_t now;
    sid_excite_guard(excite, in, &now);
    const sid_osc_t osc = sid_osc_at(excite->increment_q64 * now.tick);
    out->reference_q8 = sid_excite_reference(excite, &now, osc.sine_q31);
    out->held = now.trip;
}
