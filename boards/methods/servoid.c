// sid_bin and sid_inertia by themselves.
#include "method.h"

#include "servoid/servoid.h"

static sid_bin_t bin;
static sid_result_t result;

method_answer_t method_answer[METHOD_ANSWERS] = {{"servoid", 0, 0}, {0, 0, 0}};
void* const method_state = &bin;
const uint32_t method_state_words = sizeof(bin) / 4U;

void method_begin(uint64_t frequency_uHz) {
    const uint64_t rate_uHz = METHOD_RATE_HZ * (uint64_t)1000000;
    (void)sid_bin_start(&bin, sid_phase_increment(frequency_uHz, rate_uHz), 0, METHOD_COUNT);
}

void method_step(int32_t torque_pu_q20, int32_t position_count) {
    sid_bin_step(&bin, torque_pu_q20, position_count);
}

// The result is per rated torque, which is 2^20 here.
static float value(sid_scaled_t scaled) {
    union {
        uint32_t word;
        float value;
    } power;
    power.word = (uint32_t)(scaled.exponent + 20 + 127) << 23;
    return (float)scaled.mantissa * power.value;
}

void method_solve(void) {
    static const sid_inertia_config_t config;
    (void)sid_bin_gram_advance(&bin, METHOD_COUNT);
    if (sid_inertia_solve(&bin, &config, &result) == SID_OK) {
        method_answer[0].inertia = value(result.inertia);
        method_answer[0].viscous = value(result.viscous);
    }
}
