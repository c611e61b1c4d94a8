// The textbook's correlation with one line, in float, sine and cosine of the C library in each
// sample.
#include "method.h"

#include <math.h>

static struct {
    float torque[2];
    float position[2];
    float omega;
    uint32_t index;
} dft;

method_answer_t method_answer[METHOD_ANSWERS] = {{"float DFT", 0, 0}, {0, 0, 0}};
void* const method_state = &dft;
const uint32_t method_state_words = sizeof(dft) / 4U;

void method_begin(uint64_t frequency_uHz) {
    dft.torque[0] = dft.torque[1] = dft.position[0] = dft.position[1] = 0.0F;
    dft.omega = 6.28318530717958648F * (float)frequency_uHz / (1e6F * (float)METHOD_RATE_HZ);
    dft.index = 0;
}

void method_step(int32_t torque_pu_q20, int32_t position_count) {
    const float angle = dft.omega * (float)dft.index;
    const float c = cosf(angle);
    const float s = sinf(angle);
    const float torque = (float)torque_pu_q20;
    const float position = (float)position_count;
    dft.torque[0] += torque * c;
    dft.torque[1] += torque * s;
    dft.position[0] += position * c;
    dft.position[1] += position * s;
    dft.index++;
}

void method_solve(void) {
    method_from_phasors(&method_answer[0], dft.torque, dft.position, 1.0F, dft.omega);
}
