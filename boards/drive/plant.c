#include "plant.h"

#define STEPS_PER_SAMPLE 50

plant_t plant_system_1(void) {
    plant_t plant;
    plant.inertia_kgm2 = 0.116e-4;
    plant.viscous_Nms = 0.75e-4;
    plant.coulomb_Nm = 6.6e-3;
    plant.rated_Nm = 0.637;
    plant.sample_s = 125e-6;
    plant.count_rad = 2 * 3.14159265358979323846 / 131072;
    plant.encoder_mask = 131071;
    plant.angle_rad = 0;
    plant.speed_rad_s = 0;
    return plant;
}

// Speed after friction has taken its share of it, at most all.
static double braked(double speed, double friction) {
    if (speed > friction) {
        return speed - friction;
    }
    return (speed < -friction) ? speed + friction : 0;
}

void plant_advance(plant_t* plant, int32_t torque_pu_q20) {
    const double torque_Nm = torque_pu_q20 / 1048576.0 * plant->rated_Nm;
    const double step_s = plant->sample_s / STEPS_PER_SAMPLE;
    const double per_inertia = step_s / plant->inertia_kgm2;
    const double friction = per_inertia * plant->coulomb_Nm;
    for (int i = 0; i < STEPS_PER_SAMPLE; i++) {
        const double drive_Nm = torque_Nm - plant->viscous_Nms * plant->speed_rad_s;
        const double next = braked(plant->speed_rad_s + per_inertia * drive_Nm, friction);
        plant->angle_rad += step_s * 0.5 * (plant->speed_rad_s + next);
        plant->speed_rad_s = next;
    }
}

int32_t plant_count(const plant_t* plant) {
    const double counts = plant->angle_rad / plant->count_rad;
    const int32_t toward_zero = (int32_t)counts;
    return toward_zero - ((counts < toward_zero) ? 1 : 0);
}

uint32_t plant_raw(const plant_t* plant) {
    return (uint32_t)plant_count(plant) & plant->encoder_mask;
}
