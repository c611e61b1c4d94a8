/// The contract with a drive, and the porting manual.
///
/// A port is five plain functions and two calls. Copy boards/blank, fill in the five functions,
/// call sid_identify_step from the control interrupt and sid_identify_poll from the main loop. The
/// core never calls these functions itself and holds no pointer to them: they fix the meaning of
/// what goes in and out, and let a port be written and reviewed file by file.
///
/// 1. Time     is the number of calls. The core reads no clock. The interrupt must come at a
///             constant rate; a lost interrupt is a jump of phase and shows as residual. Give the
///             rate to sid_phase_increment().
/// 2. Position is the encoder's word as it is, rolling over at its own width (position_bits). It is
///             sampled at the beginning of the interrupt, always at the same distance from the
///             timer.
/// 3. Torque   is what the drive asks of the current loop, or measures, as a fraction of rated
///             torque in Q20. Say in torque_timing which it is:
///               SID_TORQUE_SAMPLED    measured at the instant of the position
///               SID_TORQUE_HELD_NEXT  computed from this position, held until the next interrupt
///               SID_TORQUE_HELD_LAST  computed in the last interrupt, held until this one
/// 4. Reference comes back in Q8 counts relative to where the axis stood at
///             sid_identify_start(). Add it to the position reference of the drive's own loop, or
///             give it to sid_loop_step(). When command.held is negative a guard has tripped: the
///             reference then is the measured position and stays.
/// 5. Order    in the interrupt, with SID_TORQUE_HELD_LAST:
///                 sid_hal_read(&sample);
///                 sid_identify_step(&session, &sample, &command);
///                 sid_hal_write_reference(command.reference_q8);
///             In the main loop:
///                 state = sid_identify_poll(&session, 64);
/// 6. Limits   of the axis belong into the configuration: stroke, torque, largest plausible
///             movement per sample. They act inside the interrupt, in the same sample. They do not
///             replace the drive's own protection.
/// 7. Sharing  sid_identify_start, _poll, _abort and _init run in the background and may be
///             interrupted by sid_identify_step, not the reverse. On one core nothing has to be
///             locked. Where step and poll run on different cores, define SID_FENCE as a memory
///             barrier; where the background can preempt the interrupt, bracket the background
///             calls with sid_hal_enter_critical and sid_hal_exit_critical.
/// 8. Bus      Only with sid_node.h: the interrupt calls sid_node_step in place of
///             sid_identify_step, the main loop gives what sid_hal_can_receive brings to
///             sid_node_receive, and what that and sid_node_poll fill to sid_hal_can_send. The
///             reference is relative to node.run.start_raw (boards/blank_can).
///
/// Units       As in sid_excite.h.
/// Interrupt   sid_hal_read and sid_hal_write_reference: yes, and they should be short.
/// Memory      None here.
#ifndef SERVOID_SID_HAL_H
#define SERVOID_SID_HAL_H

#include "servoid/sid_can.h"
#include "servoid/sid_excite.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Present encoder word and torque. Must not wait.
void sid_hal_read(sid_sample_t* sample);
/// Hands the reference to the position loop.
void sid_hal_write_reference(int32_t reference_q8);
/// Sample rate of the interrupt in microhertz; constant.
uint64_t sid_hal_sample_rate_uHz(void);
/// The next frame that has come; false if there is none. Must not wait.
bool sid_hal_can_receive(sid_can_frame_t* frame);
/// Gives a frame to the controller; false if it has no room. Must not wait.
bool sid_hal_can_send(const sid_can_frame_t* frame);
/// Keep the control interrupt out; never nested. Empty on most ports.
void sid_hal_enter_critical(void);
void sid_hal_exit_critical(void);

#ifdef __cplusplus
}
#endif
#endif
