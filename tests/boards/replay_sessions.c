#include "board.h"
#include "replay.h"

#define PLAN 3U
#define MOST_SAMPLES 12000U

// What is done to the samples of a session.
typedef struct {
    const char* name;
    uint32_t first_raw;      ///< where the encoder stands at the start
    int32_t position_scale;  ///< amplitude, counts in units of 2^15
    int32_t torque_scale;    ///< Q20 in units of 2^15; negative: an inertia
    int32_t torque_noise;    ///< Q20
    int32_t torque_clip;     ///< Q20; 0: none
    uint32_t jump_at;        ///< sample, 0: never
    uint32_t freeze_at;      ///< sample, 0: never
    uint32_t garbage_one_in; ///< 0: none
    uint8_t position_bits;   ///< of the encoder
    uint8_t position_shift;  ///< counts dropped
    uint8_t windows;         ///< per frequency
    int32_t stroke_limit;    ///< 0: the default
    int32_t torque_limit;    ///< 0: the default
    int32_t saturation;      ///< 0: none
    sid_bin_method_t method; ///< trend
    sid_torque_timing_t timing;
} scene_t;

static const scene_t scenes[] = {{"clean", 0, 1000, -200000, 2000, 0, 0, 0, 0, 17, 0, 2, 0, 0, 0,
                                  SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"rolls over", 131000, 20000, -300000, 20000, 0, 0, 0, 0, 17, 2, 3,
                                  0, 0, 0, SID_BIN_QUADRATIC, SID_TORQUE_SAMPLED},
                                 {"rolls over 32 bits", 0xFFFFFFF0U, 30000, -100000, 1, 0, 0, 0, 0,
                                  32, 0, 1, 0, 0, 0, SID_BIN_LINEAR, SID_TORQUE_HELD_NEXT},
                                 {"plain", 7, 1000, -200000, 2000, 0, 0, 0, 0, 20, 8, 8, 0, 0, 0,
                                  SID_BIN_PLAIN_DFT, SID_TORQUE_SAMPLED},
                                 {"saturated", 0, 1000, -400000, 0, 150000, 0, 0, 0, 17, 0, 2, 0, 0,
                                  150000, SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"jump", 0, 1000, -200000, 0, 0, 1500, 0, 0, 17, 0, 2, 0, 0, 0,
                                  SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"stuck", 0, 1000, -200000, 0, 0, 0, 1400, 0, 17, 0, 2, 0, 0, 0,
                                  SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"stroke", 0, 2000, -200000, 0, 0, 0, 0, 0, 17, 0, 2, 1900, 0, 0,
                                  SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"torque", 0, 1000, -200000, 0, 0, 0, 0, 0, 17, 0, 2, 0, 150000, 0,
                                  SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"negative inertia", 0, 1000, 200000, 0, 0, 0, 0, 0, 17, 0, 1, 0,
                                  0, 0, SID_BIN_CUBIC, SID_TORQUE_SAMPLED},
                                 {"largest samples", 0, 4000000, -8000000, 380000, 0, 0, 0, 0, 32,
                                  0, 1, 0, 0, 0, SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"garbage", 99, 1000, -200000, 100000, 0, 0, 0, 400, 17, 0, 2, 0,
                                  0, 0, SID_BIN_CUBIC, SID_TORQUE_HELD_LAST},
                                 {"nothing but garbage", 99, 1000, -200000, 100000, 0, 0, 0, 1, 17,
                                  0, 2, 0, 0, 0, SID_BIN_CUBIC, SID_TORQUE_HELD_LAST}};

typedef struct {
    sid_identify_t session;
    sid_identify_config_t config;
    sid_frequency_t plan[PLAN];
    sid_result_t results[PLAN];
    uint32_t frozen_raw;
    uint32_t sample;
    replay_digest_t digest;
} replay_t;

static replay_t replay;

static int32_t noise(int32_t size) {
    return (int32_t)(((int64_t)size * (int32_t)replay_random()) >> 31);
}

static int32_t clip(int32_t x, int32_t limit) {
    return (limit == 0) ? x : sid_clamp(x, -limit, limit);
}

static sid_sample_t make_sample(const scene_t* scene) {
    const uint32_t k = replay.sample;
    const uint32_t tick = replay.session.excite.tick;
    const uint32_t step = (uint32_t)(replay.session.excite.increment_q64 >> 32);
    const int32_t sine = (tick < SID_TICK_PARKED) ? replay_sine(step * tick) : 0;
    const int32_t drift = (int32_t)(k >> 5);
    sid_sample_t in;
    in.position_raw = scene->first_raw + (uint32_t)drift +
                      (uint32_t)(((int64_t)sine * scene->position_scale) >> 15);
    in.torque_pu_q20 = (int32_t)(((int64_t)sine * scene->torque_scale) >> 15);
    in.torque_pu_q20 = clip(in.torque_pu_q20 + noise(scene->torque_noise), scene->torque_clip);
    in.position_raw += (k == scene->jump_at && k != 0U) ? 60000U : 0U;
    if ((scene->freeze_at == 0U) || (k < scene->freeze_at)) {
        replay.frozen_raw = in.position_raw;
    }
    in.position_raw = replay.frozen_raw;
    if ((scene->garbage_one_in != 0U) && (replay_random() % scene->garbage_one_in == 0U)) {
        in.position_raw = replay_random();
        in.torque_pu_q20 = (int32_t)replay_random();
    }
    return in;
}

static bool begin(const scene_t* scene) {
    static const uint64_t frequency_uHz[PLAN] = {53000000U, 100000000U, 211300000U};
    static const replay_t nothing;
    replay = nothing;
    for (uint32_t i = 0; i < PLAN; i++) {
        replay.plan[i].increment_q64 = sid_phase_increment(frequency_uHz[i], 8000000000U);
        replay.plan[i].amplitude_q8 = 300000 + 1000 * (int32_t)i;
    }
    replay.config.plan = replay.plan;
    replay.config.results = replay.results;
    replay.config.plan_length = PLAN;
    replay.config.windows = scene->windows;
    replay.config.position_bits = scene->position_bits;
    replay.config.position_shift = scene->position_shift;
    replay.config.ramp_periods_q8 = 300;
    replay.config.settle_periods_q8 = 700;
    replay.config.window_periods_q8 = 700;
    replay.config.rest_samples = 17;
    replay.config.stroke_limit_count = scene->stroke_limit;
    replay.config.torque_limit_pu_q20 = scene->torque_limit;
    replay.config.torque_saturation_pu_q20 = scene->saturation;
    replay.config.method = scene->method;
    replay.config.torque_timing = scene->timing;
    return sid_identify_init(&replay.session, &replay.config) &&
           sid_identify_start(&replay.session, scene->first_raw);
}

static void print_result(const sid_result_t* r) {
    replay_print_scaled("J", r->inertia);
    replay_print_scaled("+-", r->inertia_std);
    replay_print_scaled("D", r->viscous);
    replay_print_scaled("+-", r->viscous_std);
    replay_print_scaled("torque", r->torque_amplitude);
    replay_print_scaled("position", r->position_amplitude);
    replay_print_scaled("residuals", r->torque_residual);
    replay_print_scaled("", r->position_residual);
    replay_print_scaled("pivot", r->smallest_pivot);
    replay_print("windows", r->windows);
    replay_print("known", r->std_known ? 1 : 0);
    board_print(" ");
    board_print(sid_reason_text((sid_reason_t)r->reason));
    replay_end_line();
}

static void print_end(void) {
    const sid_counters_t* const c = &replay.session.counters;
    for (uint32_t i = 0; i < PLAN; i++) {
        print_result(&replay.results[i]);
    }
    replay_print("state", replay.session.state);
    replay_print("samples", replay.sample);
    replay_print("saturated", c->torque_saturated_samples);
    replay_print("aborts", c->torque_aborts);
    replay_print("", c->stroke_aborts);
    replay_print("", c->encoder_jumps);
    replay_print("", c->encoder_stuck);
    replay_print("", c->user_aborts);
    replay_print("missed", c->missed_polls);
    board_print(" ");
    board_print(sid_reason_text(sid_identify_reason(&replay.session)));
    replay_end_line();
}

// A window is over and its sums have not been evaluated yet.
static bool is_window_full(void) {
    const sid_identify_t* const s = &replay.session;
    return (s->state == SID_STATE_MEASURING) &&
           (s->excite.tick == s->window_start + s->window_count);
}

static void run(const scene_t* scene) {
    sid_state_t state = SID_STATE_MEASURING;
    while ((state < SID_STATE_DONE) && (replay.sample < MOST_SAMPLES)) {
        const sid_sample_t in = make_sample(scene);
        sid_command_t out;
        sid_identify_step(&replay.session, &in, &out);
        replay_digest(&replay.digest, (uint32_t)out.reference_q8);
        replay_digest(&replay.digest, (uint32_t)out.held);
        if (is_window_full()) {
            replay_print_bin(&replay.session.bin);
            replay_print("saturated", replay.session.saturated);
            replay_end_line();
        }
        state = sid_identify_poll(&replay.session, 64);
        replay.sample++;
        if (replay.sample % 500U == 0U) {
            replay_print("commands", (int64_t)replay.digest.sum);
            replay_end_line();
        }
    }
}

void replay_sessions(void) {
    for (uint32_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
        board_print("session: ");
        board_print(scenes[i].name);
        board_print(begin(&scenes[i]) ? "\n" : " refused\n");
        run(&scenes[i]);
        print_end();
    }
}
