/// One way to find J and D of a window, to be measured beside others: boards/peers.
///
/// Purpose     Each program holds one method, so that what it links is what that method needs.
/// Order       method_begin, method_step with each sample of the window (in the interrupt),
///             method_solve (in the background).
/// Units       Torque Q20 of rated torque, position in counts from the start. Results per sample:
///             J in Q20 torque per (count / sample^2), D in Q20 torque per (count / sample).
#ifndef SERVOID_METHOD_H
#define SERVOID_METHOD_H

#include <stdint.h>

#define METHOD_COUNT 1024U ///< samples in the window
#define METHOD_RATE_HZ 8000U

/// What an implementation may give in beside its first answer.
#define METHOD_ANSWERS 2

typedef struct {
    const char* name;
    float inertia;
    float viscous;
} method_answer_t;

extern method_answer_t method_answer[METHOD_ANSWERS];
/// What method_step changes, buffers of samples aside: saved and restored around it.
extern void* const method_state;
extern const uint32_t method_state_words;

void method_begin(uint64_t frequency_uHz);
void method_step(int32_t torque_pu_q20, int32_t position_count);
void method_solve(void);

/// J and D from the phasors T = tc - j ts and H = hc - j hs; the scale of T over that of H is given
/// apart.
static inline void method_from_phasors(method_answer_t* answer, const float torque[2],
                                       const float position[2], float scale, float omega) {
    const float re = torque[0] * position[0] + torque[1] * position[1];
    const float im = torque[0] * position[1] - torque[1] * position[0];
    const float square = position[0] * position[0] + position[1] * position[1];
    answer->inertia = -re / (omega * omega * square) * scale;
    answer->viscous = im / (omega * square) * scale;
}

#endif
