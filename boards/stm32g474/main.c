// Power-up, and the main loop until the master asks for a reset.
#include "clock.h"
#include "power_stage.h"
#include "servo.h"
#include "stm32g474.h"

int main(void);

static void count_cycles(void) {
    *DCB_DEMCR |= DCB_DEMCR_TRCENA;
    *DWT_CTRL |= DWT_CTRL_CYCCNTENA;
}

// Where something is missing the outputs stay off, and the watchdog or the power begins anew.
int main(void) {
    *SCB_VTOR = 0x08000000U;
    count_cycles();
    if (!clock_init() || !watchdog_init() || !servo_init() || !power_stage_init()) {
        for (;;) {
        }
    }
    power_stage_start();
    while (!servo_may_reset()) {
        servo_serve();
    }
    return 0;
}
