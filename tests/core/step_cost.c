/* One call of sid_identify_step on a hard case, chosen by the argument, so that callgrind can count
 * its instructions. */
#include "servoid/servoid.h"

#include <stdio.h>
#include <stdlib.h>

static sid_identify_t session;
static sid_result_t results[1];

static uint32_t noise(void) {
    static uint32_t state = 2463534242U;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

static void advance(int steps) {
    for (int k = 0; k < steps; k++) {
        const sid_sample_t in = {noise() & 1U, (int32_t)(noise() & 0xFFFFU) - 0x8000};
        sid_command_t out;
        sid_identify_step(&session, &in, &out);
        (void)sid_identify_poll(&session, 16);
    }
}

/* The call that is counted. */
void counted(const sid_sample_t* in, sid_command_t* out);
__attribute__((noinline)) void counted(const sid_sample_t* in, sid_command_t* out) {
    sid_identify_step(&session, in, out);
}

int main(int argc, char** argv) {
    static const int32_t torque[] = {0,       1,        -1,        1 << 20,  -(1 << 20),
                                     8388607, -8388608, INT32_MAX, INT32_MIN};
    static const uint32_t position[] = {0,           1,     0xFFFFFFFFU, 0x7FFFFFFFU,
                                        0x80000000U, 12345, 0xFFFF0000U};
    static const int before[] = {-1, 0, 3, 79, 80, 300, 650, 799, 800, 960, 1100, 5000};
    const int kase = (argc > 1) ? atoi(argv[1]) : 0;
    sid_frequency_t plan;
    sid_identify_config_t config = {0};
    plan.increment_q64 = sid_phase_increment(100, 8000);
    plan.amplitude_q8 = 1 << 20;
    config.plan = &plan;
    config.results = results;
    config.plan_length = 1;
    config.ramp_periods_q8 = 256;
    config.torque_saturation_pu_q20 = 1 << 19;
    if (!sid_identify_init(&session, &config)) {
        return 1;
    }
    const int phase = before[kase % 12];
    if (phase >= 0) {
        (void)sid_identify_start(&session, 0);
        advance(phase);
    }
    sid_sample_t in;
    sid_command_t out;
    in.torque_pu_q20 = torque[(kase / 12) % 9];
    in.position_raw = position[(kase / 108) % 7];
    counted(&in, &out);
    if (kase == 0) {
        printf("state: sid_identify_t %u, sid_bin_t %u, sid_excite_t %u, sid_loop_t %u, "
               "sid_friction_t %u bytes\n",
               (unsigned)sizeof(sid_identify_t), (unsigned)sizeof(sid_bin_t),
               (unsigned)sizeof(sid_excite_t), (unsigned)sizeof(sid_loop_t),
               (unsigned)sizeof(sid_friction_t));
    }
    return 0;
}
