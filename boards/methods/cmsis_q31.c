// The window in two buffers, then CMSIS-DSP's real FFT in Q31 of each, and the line next to the
// frequency: as it is, and under a Hann window, which is three lines of the same spectrum.
#include "method.h"

#include "arm_math.h"

static q31_t torque[METHOD_COUNT];
static q31_t position[METHOD_COUNT];
static q31_t spectrum[2U * METHOD_COUNT]; // what the library asks for
static arm_rfft_instance_q31 fft;
static uint64_t frequency;
static uint32_t count;

method_answer_t method_answer[METHOD_ANSWERS] = {{"FFT", 0, 0}, {"FFT, Hann", 0, 0}};
void* const method_state = &count;
const uint32_t method_state_words = 1;

void method_begin(uint64_t frequency_uHz) {
    (void)arm_rfft_init_1024_q31(&fft, 0, 1);
    frequency = frequency_uHz;
    count = 0;
}

void method_step(int32_t torque_pu_q20, int32_t position_count) {
    torque[count] = torque_pu_q20;
    position[count] = position_count;
    count++;
}

typedef struct {
    float line[2][2]; // cosine and sine: plain, Hann
    float scale;
} phasors_t;

// The mean is taken out and the rest shifted up as far as it goes, or a small signal would drown in
// the FFT's scaling by the number of samples.
static phasors_t transform(q31_t* samples, uint32_t bin) {
    q31_t mean;
    q31_t most;
    uint32_t at;
    phasors_t out;
    arm_mean_q31(samples, METHOD_COUNT, &mean);
    arm_offset_q31(samples, -mean, samples, METHOD_COUNT);
    arm_absmax_q31(samples, METHOD_COUNT, &most, &at);
    const int8_t shift = (int8_t)(__CLZ((uint32_t)most | 1U) - 1U);
    arm_shift_q31(samples, shift, samples, METHOD_COUNT);
    arm_rfft_q31(&fft, samples, spectrum);
    for (uint32_t part = 0; part < 2U; part++) {
        const float sign = (part == 0U) ? 1.0F : -1.0F;
        const float here = (float)spectrum[2U * bin + part];
        const float beside =
            (float)spectrum[2U * (bin - 1U) + part] + (float)spectrum[2U * (bin + 1U) + part];
        out.line[0][part] = sign * here;
        out.line[1][part] = sign * (0.5F * here - 0.25F * beside);
    }
    out.scale = 1.0F / (float)((uint32_t)1 << shift);
    return out;
}

void method_solve(void) {
    const float turn = (float)frequency / (1e6F * (float)METHOD_RATE_HZ);
    const uint32_t bin = (uint32_t)(turn * (float)METHOD_COUNT + 0.5F);
    const phasors_t t = transform(torque, bin);
    const phasors_t h = transform(position, bin);
    for (int i = 0; i < METHOD_ANSWERS; i++) {
        method_from_phasors(&method_answer[i], t.line[i], h.line[i], t.scale / h.scale,
                            6.28318530717958648F * turn);
    }
}
