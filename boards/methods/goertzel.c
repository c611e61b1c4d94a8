// Goertzel's recursion in float: one multiplication a sample and channel, the phasors at the end.
#include "method.h"

#include <math.h>

static struct {
    float torque[2];
    float position[2];
    float twice_cosine;
    float omega;
} goertzel;

method_answer_t method_answer[METHOD_ANSWERS] = {{"float Goertzel", 0, 0}, {0, 0, 0}};
void* const method_state = &goertzel;
const uint32_t method_state_words = sizeof(goertzel) / 4U;

void method_begin(uint64_t frequency_uHz) {
    goertzel.torque[0] = goertzel.torque[1] = 0.0F;
    goertzel.position[0] = goertzel.position[1] = 0.0F;
    goertzel.omega = 6.28318530717958648F * (float)frequency_uHz / (1e6F * (float)METHOD_RATE_HZ);
    goertzel.twice_cosine = 2.0F * cosf(goertzel.omega);
}

static inline void advance(float s[2], float x) {
    const float next = x + goertzel.twice_cosine * s[0] - s[1];
    s[1] = s[0];
    s[0] = next;
}

void method_step(int32_t torque_pu_q20, int32_t position_count) {
    advance(goertzel.torque, (float)torque_pu_q20);
    advance(goertzel.position, (float)position_count);
}

// Both phasors turned by the same angle: J and D do not see it.
static void phasor(const float s[2], float cosine, float sine, float out[2]) {
    out[0] = s[0] - s[1] * cosine;
    out[1] = -s[1] * sine;
}

void method_solve(void) {
    const float cosine = 0.5F * goertzel.twice_cosine;
    const float sine = sinf(goertzel.omega);
    float torque[2];
    float position[2];
    phasor(goertzel.torque, cosine, sine, torque);
    phasor(goertzel.position, cosine, sine, position);
    method_from_phasors(&method_answer[0], torque, position, 1.0F, goertzel.omega);
}
