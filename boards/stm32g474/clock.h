/// Clock tree: HSE crystal -> PLL -> 170 MHz for core, buses and timers. And the watchdog.
#ifndef SERVOID_CLOCK_H
#define SERVOID_CLOCK_H

#include <stdbool.h>

#define CLOCK_HSE_HZ 24000000U // PORT: the crystal; CLOCK_PLLM divides it to 4 MHz
#define CLOCK_PLLM 6U
#define CLOCK_PLLN 85U
#define CLOCK_PLLR 2U
#define CLOCK_HZ (CLOCK_HSE_HZ / CLOCK_PLLM * CLOCK_PLLN / CLOCK_PLLR)

/// False if the crystal or the PLL does not come: the internal oscillator is too inaccurate for a
/// sample rate (its error counts twice in the inertia) and for CAN.
bool clock_init(void);

#define WATCHDOG_MS 250U

/// The processor is reset unless watchdog_kick comes every WATCHDOG_MS.
bool watchdog_init(void);
void watchdog_kick(void);

#endif
