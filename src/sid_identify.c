#include "servoid/sid_identify.h"

#include <string.h>

// index - WINDOW_NEVER has its sign bit set for every tick: no sample is inside.
static const uint32_t WINDOW_NEVER = 0x80000000U;

// ---------------------------------------------------------------- configuration

static uint32_t or_default(uint32_t value, uint32_t preset) {
    return (value != 0U) ? value : preset;
}

static int32_t torque_limit(const sid_identify_config_t* config) {
    return (config->torque_limit_pu_q20 != 0) ? config->torque_limit_pu_q20 : SID_SAMPLE_LIMIT;
}

sid_excite_config_t sid_identify_guards(const sid_identify_config_t* config) {
    sid_excite_config_t out;
    out.position_bits = (uint8_t)or_default(config->position_bits, 32);
    out.position_shift = config->position_shift;
    out.step_limit = config->step_limit_count;
    if (out.step_limit == 0) {
        const int32_t range_bits = (out.position_bits > 4U) ? out.position_bits - 3 : 1;
        out.step_limit = (int32_t)1 << ((range_bits > 22) ? 22 : range_bits);
    }
    out.stroke_limit = config->stroke_limit_count;
    if ((out.stroke_limit == 0) && (out.position_shift <= 8U)) {
        out.stroke_limit = SID_SAMPLE_LIMIT - (out.step_limit >> out.position_shift);
    }
    out.torque_limit = torque_limit(config);
    return out;
}

// Everything about a leg that follows from the configuration.
typedef struct {
    sid_leg_t leg;
    uint32_t window;
    uint32_t first_window;
    uint32_t window_pitch;
    uint32_t leg_over;
} sid_schedule_t;

static sid_schedule_t schedule(const sid_identify_config_t* config, uint8_t plan_index) {
    const uint64_t increment = config->plan[plan_index].increment_q64;
    const uint32_t settle = or_default(config->settle_periods_q8, 2048);
    const uint32_t gap = or_default(config->gap_periods_q8, 256);
    const uint32_t period = sid_samples_of_periods(256, increment);
    const uint32_t windows = or_default(config->windows, 1);
    sid_schedule_t out;
    out.leg.increment_q64 = increment;
    out.leg.amplitude_q8 = config->plan[plan_index].amplitude_q8;
    out.leg.ramp_ticks = sid_samples_of_periods(config->ramp_periods_q8, increment);
    out.leg.stuck_limit = or_default(config->stuck_limit_pu_q20,
                                     (period < 4096U) ? (period + 1U) << 18 : (uint32_t)1 << 30);
    out.window = sid_samples_of_periods(or_default(config->window_periods_q8, 512), increment);
    out.first_window = out.leg.ramp_ticks + sid_samples_of_periods(settle, increment);
    out.window_pitch = out.window + sid_samples_of_periods(gap, increment);
    out.leg.leg_ticks = out.first_window + (windows - 1U) * out.window_pitch + out.window;
    out.leg_over = out.leg.leg_ticks + out.leg.ramp_ticks + 2U + config->rest_samples;
    return out;
}

// 255 periods each, at more than 2 samples per period: no sum in schedule() wraps once the window
//             fits.
static bool is_plan_valid(const sid_identify_config_t* config) {
    for (uint8_t i = 0; i < config->plan_length; i++) {
        const uint64_t increment = config->plan[i].increment_q64;
        const sid_schedule_t plan = schedule(config, i);
        if ((increment == 0U) || (increment >= ((uint64_t)1 << 63)) ||
            (plan.leg.amplitude_q8 < 0) || (plan.leg.amplitude_q8 >= (1 << 30)) ||
            (plan.leg.stuck_limit > ((uint32_t)1 << 30)) || (plan.window < SID_BIN_COUNT_MIN) ||
            (plan.window > SID_BIN_COUNT_MAX) || (plan.leg_over > ((uint32_t)1 << 30))) {
            return false;
        }
    }
    return true;
}

bool sid_identify_init(sid_identify_t* session, const sid_identify_config_t* config) {
    const sid_excite_config_t guards = sid_identify_guards(config);
    memset(session, 0, sizeof(*session));
    session->config = config;
    session->window_start = WINDOW_NEVER;
    session->saturation_below = (config->torque_saturation_pu_q20 != 0)
                                    ? config->torque_saturation_pu_q20 - 1
                                    : SID_SAMPLE_LIMIT;
    const bool guarded = sid_excite_init(&session->excite, &guards);
    if ((config->plan == NULL) || (config->results == NULL) || (config->plan_length == 0U)) {
        return false;
    }
    memset(config->results, 0, config->plan_length * sizeof(config->results[0]));
    return guarded && (config->windows <= 8U) && (session->saturation_below >= 0) &&
           (config->rest_samples < ((uint32_t)1 << 29)) && is_plan_valid(config);
}

// ---------------------------------------------------------------- interrupt

// The sample of a trip still enters the sums, whatever it is: one sample cannot overflow them
// (sid_bin.h), and the session ends there anyway.
void sid_identify_step(sid_identify_t* session, const sid_sample_t* in, sid_command_t* out) {
    sid_bin_t* const bin = &session->bin;
    sid_tick_t now;
    sid_excite_guard(&session->excite, in, &now);
    out->held = now.trip;
    const uint32_t index = now.tick - session->window_start;
    const int32_t inside = (int32_t)((index - session->window_count) & ~index) >> 31;
    const uint32_t full =
        (uint32_t)(session->saturation_below - now.torque_magnitude) & (uint32_t)inside;
    session->saturated += full >> 31;
    const sid_osc_t osc = sid_osc(session->excite.increment_q64 * now.tick);
    out->reference_q8 = sid_excite_reference(&session->excite, &now, osc.sine_q31);
    sid_bin_accumulate(bin, sid_bin_row(osc, sid_bin_tau(bin, index)), now.torque & inside,
                       now.position & inside);
}

// ---------------------------------------------------------------- background

static void arm_window(sid_identify_t* session, uint32_t start, uint32_t count) {
    const uint64_t increment = session->excite.increment_q64;
    session->window_start = WINDOW_NEVER;
    SID_FENCE();
    (void)sid_bin_start(&session->bin, increment, increment * start, count);
    session->saturated = 0;
    session->window_count = count;
    SID_FENCE();
    session->window_start = start;
    SID_FENCE();
}

static void begin_leg(sid_identify_t* session) {
    const sid_schedule_t plan = schedule(session->config, session->plan_index);
    session->excite.tick = SID_TICK_PARKED;
    SID_FENCE();
    session->first_window = plan.first_window;
    session->window_pitch = plan.window_pitch;
    session->leg_over = plan.leg_over;
    session->window_index = 0;
    session->state = SID_STATE_MEASURING;
    session->excite.increment_q64 = plan.leg.increment_q64;
    arm_window(session, plan.first_window, plan.window);
    (void)sid_excite_begin(&session->excite, &plan.leg);
}

bool sid_identify_start(sid_identify_t* session, uint32_t position_raw) {
    const sid_identify_config_t* const config = session->config;
    if ((session->state == SID_STATE_MEASURING) || (session->state == SID_STATE_STOPPING) ||
        !is_plan_valid(config)) {
        return false;
    }
    memset(config->results, 0, config->plan_length * sizeof(config->results[0]));
    session->plan_index = 0;
    session->reason = SID_NOT_RUN;
    session->abort_requested = false;
    session->give_up = false;
    session->excite.torque_limit = torque_limit(config);
    sid_excite_rebase(&session->excite, position_raw);
    begin_leg(session);
    return true;
}

static void note(sid_identify_t* session, sid_reason_t reason) {
    session->config->results[session->plan_index].reason = (uint8_t)reason;
    if ((reason != SID_OK) && (session->reason == SID_NOT_RUN)) {
        session->reason = (uint8_t)reason;
    }
}

static void end(sid_identify_t* session, sid_state_t state) {
    sid_excite_park(&session->excite);
    session->window_start = WINDOW_NEVER;
    session->state = (uint8_t)state;
    if (session->reason == SID_NOT_RUN) {
        session->reason = SID_OK;
    }
}

static sid_reason_t count_trip(sid_identify_t* session) {
    sid_counters_t* const counters = &session->counters;
    if (session->abort_requested) {
        counters->user_aborts = sid_count(counters->user_aborts, 1);
        return SID_ABORTED_BY_USER;
    }
    switch (sid_excite_trip(&session->excite)) {
    case SID_TRIP_STUCK:
        counters->encoder_stuck = sid_count(counters->encoder_stuck, 1);
        return SID_ENCODER_STUCK;
    case SID_TRIP_STROKE:
        counters->stroke_aborts = sid_count(counters->stroke_aborts, 1);
        return SID_ABORTED_STROKE;
    case SID_TRIP_JUMP:
        counters->encoder_jumps = sid_count(counters->encoder_jumps, 1);
        return SID_ENCODER_JUMP;
    default:
        counters->torque_aborts = sid_count(counters->torque_aborts, 1);
        return SID_ABORTED_TORQUE;
    }
}

// A trip outranks what the leg measured before it: its result is no longer of a finished leg.
static void end_tripped(sid_identify_t* session) {
    sid_result_t* const result = &session->config->results[session->plan_index];
    const sid_reason_t reason = count_trip(session);
    memset(result, 0, sizeof(*result));
    result->increment_q64 = session->excite.increment_q64;
    session->reason = SID_NOT_RUN;
    note(session, reason);
    end(session, SID_STATE_ABORTED);
}

// The bin takes any motion, and finds a fundamental in it. But an axis that sticks for part of each
// period, an encoder that froze and samples that are missing give an inertia that is none:
// simulated ones are 1.1 to 17 times too large from 8 % on. A count is left to rounding.
static bool is_sine(const sid_identify_config_t* config, const sid_result_t* window) {
    const uint32_t most = or_default(config->distortion_q8, 21);
    const int64_t amplitude_q8 = sid_scaled_to_fixed(window->position_amplitude, 8);
    const int64_t residual_q8 = sid_scaled_to_fixed(window->position_residual, 8);
    return (most == 255U) || (residual_q8 <= 256 + ((amplitude_q8 * (int64_t)most) >> 8));
}

static void refuse_distorted(const sid_identify_config_t* config, sid_result_t* window) {
    static const sid_scaled_t none = {0, 0};
    if ((window->reason == (uint8_t)SID_OK) && !is_sine(config, window)) {
        window->inertia = none;
        window->viscous = none;
        window->reason = (uint8_t)SID_NOT_A_SINE;
    }
}

static void evaluate(sid_identify_t* session) {
    const sid_identify_config_t* const config = session->config;
    sid_result_t* const result = &config->results[session->plan_index];
    sid_inertia_config_t settings;
    sid_result_t window;
    settings.method = config->method;
    settings.torque_timing = config->torque_timing;
    settings.torque_min_pu_q20 = config->torque_min_pu_q20;
    settings.position_min_q8 = config->position_min_q8;
    settings.saturated_samples = session->saturated;
    session->bin.index = session->bin.count;
    (void)sid_inertia_solve(&session->bin, &settings, &window);
    refuse_distorted(config, &window);
    if (window.reason == (uint8_t)SID_OK) {
        sid_inertia_combine(result, &window);
    } else {
        *result = window;
        session->give_up = session->saturated > session->bin.count / 4U;
    }
    note(session, (sid_reason_t)window.reason);
    session->counters.torque_saturated_samples += session->saturated;
}

// Hands the sums to the next window that has not begun; false if there is none.
static bool arm_next_window(sid_identify_t* session) {
    const uint32_t windows = or_default(session->config->windows, 1);
    const uint32_t count = session->bin.count;
    while (++session->window_index < windows) {
        const uint32_t start =
            session->first_window + session->window_index * session->window_pitch;
        if (session->excite.tick <= start) {
            arm_window(session, start, count);
            if (session->excite.tick <= start) {
                return true;
            }
        }
        session->counters.missed_polls = sid_count(session->counters.missed_polls, 1);
    }
    return false;
}

static void measure(sid_identify_t* session, uint32_t max_samples) {
    sid_result_t* const result = &session->config->results[session->plan_index];
    const bool replayed = sid_bin_gram_advance(&session->bin, max_samples);
    if (!replayed || (session->excite.tick < session->window_start + session->bin.count)) {
        return;
    }
    evaluate(session);
    if ((result->reason != SID_OK) || !arm_next_window(session)) {
        sid_inertia_finish(result);
        session->window_start = WINDOW_NEVER;
        session->state = SID_STATE_STOPPING;
        if (result->reason != SID_OK) {
            sid_excite_finish(&session->excite);
        }
    }
}

static void stop(sid_identify_t* session) {
    if (!sid_excite_is_still(&session->excite) || (session->excite.tick < session->leg_over)) {
        return;
    }
    session->plan_index++;
    if (session->give_up || (session->plan_index == session->config->plan_length)) {
        session->plan_index--;
        end(session, session->give_up ? SID_STATE_ABORTED : SID_STATE_DONE);
    } else {
        begin_leg(session);
    }
}

sid_state_t sid_identify_poll(sid_identify_t* session, uint32_t max_samples) {
    const bool running =
        (session->state == SID_STATE_MEASURING) || (session->state == SID_STATE_STOPPING);
    SID_FENCE();
    if (running && (session->excite.trip < 0)) {
        end_tripped(session);
    } else if (session->state == SID_STATE_MEASURING) {
        measure(session, max_samples);
    } else if (session->state == SID_STATE_STOPPING) {
        stop(session);
    }
    return (sid_state_t)session->state;
}

void sid_identify_abort(sid_identify_t* session) {
    if ((session->state == SID_STATE_MEASURING) || (session->state == SID_STATE_STOPPING)) {
        session->abort_requested = true;
        SID_FENCE();
        sid_excite_abort(&session->excite);
    }
}

sid_reason_t sid_identify_reason(const sid_identify_t* session) {
    const bool ended = (session->state == SID_STATE_DONE) || (session->state == SID_STATE_ABORTED);
    return ended ? (sid_reason_t)session->reason : SID_NOT_RUN;
}
