// No method: what a program holds without one.
#include "method.h"

method_answer_t method_answer[METHOD_ANSWERS] = {{"none", 0, 0}, {0, 0, 0}};
void* const method_state = 0;
const uint32_t method_state_words = 0;

void method_begin(uint64_t frequency_uHz) { (void)frequency_uHz; }
void method_step(int32_t torque_pu_q20, int32_t position_count) {
    (void)torque_pu_q20;
    (void)position_count;
}
void method_solve(void) {}
