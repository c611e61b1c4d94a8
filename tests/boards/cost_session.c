#include "cost.h"

// Samples after the start at which a session of 100 Hz is looked at: ramp, before, in and after
// the window, at rest; the last one long after the end.
static const int32_t before[] = {-1, 0, 3, 79, 80, 650, 799, 800, 960, 1100, 5000};

static sid_identify_t session;
static sid_identify_t saved;
static sid_identify_config_t config;
static sid_frequency_t plan;
static sid_result_t result;
static sid_sample_t in;
static sid_command_t out;

__attribute__((noinline)) static void nothing(sid_identify_t* s, const sid_sample_t* sample,
                                              sid_command_t* command) {
    __asm__ volatile("" ::"r"(s), "r"(sample), "r"(command));
}
static void empty(void) { nothing(&session, &in, &out); }
static void step(void) { sid_identify_step(&session, &in, &out); }

static bool begin(int32_t samples) {
    plan.increment_q64 = sid_phase_increment(100, 8000);
    plan.amplitude_q8 = 1 << 20;
    config.plan = &plan;
    config.results = &result;
    config.plan_length = 1;
    config.ramp_periods_q8 = 256;
    config.torque_saturation_pu_q20 = 1 << 19;
    bool good = sid_identify_init(&session, &config);
    good = good && ((samples < 0) || sid_identify_start(&session, 0));
    for (int32_t i = 0; i < samples; i++) {
        in.position_raw = cost_random() & 1U;
        in.torque_pu_q20 = (int32_t)(cost_random() & 0xFFFFU) - 0x8000;
        step();
        (void)sid_identify_poll(&session, 16);
    }
    return good;
}

bool cost_of_session(void) {
    static cost_t cost;
    cost.name = "sid_identify_step";
    cost.call = step;
    cost.empty = empty;
    cost.state = (uint32_t*)(void*)&session;
    cost.saved = (const uint32_t*)(const void*)&saved;
    cost.words = sizeof(session) / 4U;
    bool good = true;
    for (uint32_t phase = 0; phase < sizeof(before) / sizeof(before[0]); phase++) {
        good = begin(before[phase]) && good;
        saved = session;
        for (uint32_t i = phase % 3U; i < COST_SAMPLES; i += 3U) {
            in = cost_sample(i);
            cost_measure(&cost);
        }
    }
    cost_report(&cost);
    return good;
}
