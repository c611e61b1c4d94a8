/// The drive: the node, its control interrupt, and when the power stage may be on.
///
/// Order       The interrupt reads encoder and current, steps the node, looks for faults, and gives
///             the reference to drive_control; the voltage stands from the next trigger on.
/// Torque      What the session sees is the measured current of the winding, SID_TORQUE_SAMPLED:
///             the reference of the current loop would be free of noise, but at 400 Hz of bandwidth
///             it is not the torque.
/// Power       On from the first sample of a run to SERVO_HOLD_MS after its end, in which the loop
///             stops and holds the axis. Off everywhere else, and at once on a fault. A fault
///             stays until the processor is reset (NMT, watchdog), and ends the run.
/// Watchdog    Kicked by the main loop, and only if the control interrupt came since: whichever of
///             them dies, the outputs are off after WATCHDOG_MS. Before that, master_timeout after
///             the last heartbeat that the main loop received, the interrupt has held the axis.
#ifndef SERVOID_SERVO_H
#define SERVOID_SERVO_H

#include "servoid/sid_node.h"

#define SERVO_HOLD_MS 500U // PORT: an axis under gravity needs its brake closed in this time

typedef enum {
    SERVO_OK = 0,
    SERVO_BREAK, ///< the break input, or what else stops TIM1, during a run
    SERVO_OVERCURRENT,
    SERVO_SENSOR, ///< the two sensors contradict each other, or their zero is far off
    SERVO_OVERRUN ///< a trigger was missed, or served half a period late, in a run
} servo_fault_t;

/// Node and loops; false if a configuration is out of range.
bool servo_init(void);
/// Once round the main loop: bus, node, watchdog.
void servo_serve(void);
/// The master asked for a reset, and the power is off.
bool servo_may_reset(void);

servo_fault_t servo_fault(void);
/// Triggers that no interrupt followed, since power-up.
uint32_t servo_missed(void);

/// The control interrupt.
void ADC1_2_IRQHandler(void);

#endif
