/// The seam between the core and the motor: a reference comes in, a voltage goes out.
///
/// Purpose     What a drive already has, and will put in place of this file: position, speed and
///             current loop. This one is complete for one phase, that is a brushed DC motor or a
///             voice coil on an H-bridge. For a three-phase motor current_pu_q20 is the current of
///             the q axis and voltage_q15 its voltage, and the transformations belong around it.
/// Formula     sid_loop (position-P, speed-PI) gives a torque; a PI controller of the current, its
///             zero on the pole of the winding, gives the voltage:
///             v = Kp e + Ki sum(e), held to +-15/16 of the supply.
/// Units       Q8 counts, counts, Q20 of the rated torque and so of the rated current, Q15 of the
///             supply.
/// Interrupt   drive_control: no division, no branch on data but `powered`.
#ifndef SERVOID_DRIVE_LOOP_H
#define SERVOID_DRIVE_LOOP_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    int32_t reference_q8;   ///< position reference, relative to where the power came on
    int32_t position_count; ///< measured, relative to the same
    int32_t current_pu_q20; ///< measured
    bool powered;           ///< false: the loops start anew with the next sample
} drive_in_t;

typedef struct {
    int32_t torque_pu_q20; ///< reference of the current loop
    int32_t voltage_q15;
} drive_out_t;

/// False if a gain is out of range.
bool drive_control_init(void);
/// Once a sample, from the control interrupt.
void drive_control(const drive_in_t* in, drive_out_t* out);

#endif
