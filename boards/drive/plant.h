/// A simulated axis for boards without one: inertia, viscous and Coulomb friction, an encoder.
///
/// Purpose     What stands in for the motor. It is no part of the core and may use floating point.
/// Formula     J dv/dt = T - D v - Tc sgn v, T held over a sample, 50 explicit steps a sample.
/// Units       SI; the encoder in counts.
/// Precision   Plain operations in one order, none fused: every IEEE machine gives the same bits.
#ifndef SERVOID_PLANT_H
#define SERVOID_PLANT_H

#include <stdint.h>

typedef struct {
    double inertia_kgm2;
    double viscous_Nms;
    double coulomb_Nm;
    double rated_Nm;
    double sample_s;
    double count_rad;
    uint32_t encoder_mask;
    double angle_rad;
    double speed_rad_s;
} plant_t;

/// System 1 of Andoh 2008, doi 10.1109/TPEL.2007.909309, with an encoder of 17 bits at 8 kHz.
plant_t plant_system_1(void);
/// One sample with this torque.
void plant_advance(plant_t* plant, int32_t torque_pu_q20);
/// Encoder counts since the start, and the encoder's word.
int32_t plant_count(const plant_t* plant);
uint32_t plant_raw(const plant_t* plant);

#endif
