/// The power stage: an H-bridge on TIM1, two current sensors on ADC1 and ADC2, the encoder on TIM2.
///
/// Purpose     Registers in, integers out; what the drive does with them is elsewhere.
/// Timing      TIM1 counts up and down in 2 * POWER_STAGE_ARR cycles of 170 MHz: 40 kHz of PWM. At
///             every tenth turn, a lower one, the update event takes over the compare values and
///             triggers both ADCs: 8 kHz exactly. So a voltage that is set in one control interrupt
///             stands on the motor from the next trigger to the one after.
/// Safety      The outputs are off, and driven low, until power_stage_on. The break input takes
///             them away without the processor; so do a crystal that stops, a lockup and a
///             debugger that halts. After a break they stay off until power_stage_on.
/// Interrupt   All functions but the *_init: yes.
#ifndef SERVOID_POWER_STAGE_H
#define SERVOID_POWER_STAGE_H

#include <stdbool.h>
#include <stdint.h>

#define POWER_STAGE_RATE_HZ 8000U
#define POWER_STAGE_ARR 2125U        // turns of the counter: 170 MHz / 2 / 40 kHz
#define POWER_STAGE_HALF_PERIODS 10U // to a control period; even, so that it is always a lower turn
#define POWER_STAGE_CYCLES (POWER_STAGE_ARR * POWER_STAGE_HALF_PERIODS)
#define POWER_STAGE_MOST_VOLTAGE_Q15 30720 // 15/16: low sides recharge drivers, sensors see edges
#define POWER_STAGE_IRQ_PRIORITY 0x10U     // of the control interrupt; nothing else has one
#define POWER_STAGE_DEAD_TIME_CYCLES 85U   // PORT: 500 ns; at most 127 with this coding

/// Timers, pins and converters; the outputs are off, the control interrupt is not enabled yet.
/// False if a converter does not start.
bool power_stage_init(void);
/// Lets the trigger and the control interrupt begin.
void power_stage_start(void);

void power_stage_on(void);
void power_stage_off(void);
/// A break took the outputs away since power_stage_forgive_break.
bool power_stage_is_broken(void);
void power_stage_forgive_break(void);

/// Mean voltage across the motor as a fraction of the supply, Q15, clamped.
void power_stage_set_voltage(int32_t voltage_q15);

typedef struct {
    int32_t current_a; ///< counts of ADC1, into the motor at leg A
    int32_t current_b; ///< counts of ADC2, into the motor at leg B
} power_stage_sample_t;

/// The conversions of this trigger; acknowledges the interrupt.
power_stage_sample_t power_stage_read(void);
/// Four counts a line, modulo 2^32.
uint32_t power_stage_encoder(void);

#endif
