/// A port of the core to a board with a simulated axis: the five functions of sid_hal.h, the
/// control interrupt and the main loop.
///
/// Purpose     What a drive looks like, on a core that executes: the control interrupt is the
///             board's timer, the axis moves in the main loop in the time between two interrupts.
/// Order       The interrupt reads position and the torque of the last interrupt, steps the
///             session and the loop; the main loop moves the axis by one sample and polls.
#ifndef SERVOID_DRIVE_H
#define SERVOID_DRIVE_H

#include "plant.h"

#include "servoid/servoid.h"

#define DRIVE_RATE_HZ 8000U
#define DRIVE_PLAN 2U

typedef struct {
    sid_identify_t session;
    sid_node_t* node; ///< 0, or what is stepped in place of the session
    sid_identify_config_t config;
    sid_frequency_t plan[DRIVE_PLAN];
    sid_result_t results[DRIVE_PLAN];
    sid_loop_t loop;
    plant_t axis;
    int32_t start_count;             ///< where the session began
    volatile uint32_t samples;       ///< interrupts so far
    volatile uint32_t late;          ///< interrupts that the main loop was not ready for
    volatile int32_t torque_pu_q20;  ///< of the last interrupt
    volatile int32_t reference_q8;   ///< of the last interrupt
    volatile int32_t position_count; ///< where the axis stands
    bool is_one_encoder;             ///< the loop sees what the session sees, faults and all
    int32_t seen_count;              ///< that, unwrapped
    uint32_t moved;                  ///< samples that the axis has moved
    /// What is wrong with this HAL: changes what sid_hal_read read. 0: nothing is.
    void (*fault)(sid_sample_t* sample, uint32_t index);
    /// The same for the main loop, before it moves the axis.
    void (*stall)(uint32_t index);
} drive_t;

/// The one drive of the board.
extern drive_t drive;

/// Default configuration: 50 and 100 Hz, two windows each.
void drive_power_up(void);
/// Starts the session and, the first time, the interrupt; false if the configuration is refused.
bool drive_start(void);
/// Once round the main loop: sleeps until the next interrupt. Returns the session's state.
sid_state_t drive_main_loop(void);
/// Moves the axis by one sample.
void drive_move_axis(void);

/// J of a result in 1e-12 kg m^2, D in 1e-9 N m s.
int64_t drive_inertia_e12(const sid_result_t* result);
int64_t drive_viscous_e9(const sid_result_t* result);

#endif
