#include "stm32g474.h"

#define MOST_LOOKS 1000000U // some 50 ms; what is waited for takes 10 ms at most
#define CYCLES_PER_US 170U

bool stm32g474_wait(const reg_t* at, uint32_t mask, uint32_t value) {
    for (uint32_t i = 0; i < MOST_LOOKS; i++) {
        if ((*at & mask) == value) {
            return true;
        }
    }
    return false;
}

void stm32g474_delay_us(uint32_t us) {
    for (uint32_t i = us * CYCLES_PER_US; i > 0U; i--) {
        CORTEX_M4("nop");
    }
}
