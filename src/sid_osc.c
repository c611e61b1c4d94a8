#include "servoid/sid_osc.h"

#include "sid_real.h"

sid_osc_t sid_osc_at(uint64_t phase_q64) { return sid_osc(phase_q64); }

uint64_t sid_phase_increment(uint64_t frequency, uint64_t sample_rate) {
    uint64_t rest = 0;
    if ((sample_rate == 0U) || (sample_rate > ((uint64_t)1 << 63)) ||
        (frequency >= sample_rate - sample_rate / 2U)) {
        return 0;
    }
    const uint64_t quotient = sid_divide_128(frequency, 0, sample_rate, &rest);
    return quotient + ((rest >= sample_rate - rest) ? 1U : 0U);
}

uint32_t sid_samples_of_periods(uint32_t periods_q8, uint64_t increment_q64) {
    const uint32_t limit = (uint32_t)1 << 30;
    uint64_t rest = 0;
    if (increment_q64 == 0U) {
        return 0;
    }
    if (increment_q64 > ((uint64_t)1 << 63)) {
        increment_q64 = (uint64_t)1 << 63;
    }
    uint64_t samples =
        sid_divide_128((uint64_t)periods_q8 >> 8, (uint64_t)periods_q8 << 56, increment_q64, &rest);
    if (samples >= limit) {
        return limit;
    }
    samples += (rest >= increment_q64 - rest) ? 1U : 0U;
    return (uint32_t)samples;
}
