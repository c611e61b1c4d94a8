// The world of the blind test: a drive and its mechanics, written once more from the physics.
//
// Nothing of the project's plant, loop or effects is used: only what a hidden effect *is* (an
// effect's name and its parameters, as a model file writes them) is shared. Motion is integrated by
// drift-kick-drift steps, 100 to a control period, with dry friction as an impulse that may stop
// the axis but never turn it round.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace blind {

struct Wave {
    double amplitude = 0, number = 0, phase = 0; // number: rad per rad or m
};

// Eq. (7) of the paper, in rad/s.
struct Modes {
    double antiresonance = 0, resonance = 0, antiresonance_damping = 0, resonance_damping = 0;
};

struct World {
    bool linear = false;
    double inertia = 0;
    // Friction
    double viscous_forward = 0, viscous_reverse = 0;
    double coulomb_forward = 0, coulomb_reverse = 0;
    double stribeck_extra = 0, stribeck_velocity = 1;
    double bristle_stiffness = 0, bristle_torque = 0;
    double load_friction = 0;
    double drift = 0, drift_time = 1;
    // Other torques that oppose the motor
    double quadratic = 0, cubic_drag = 0;
    double constant = 0;
    double gravity = 0, gravity_phase = 0;
    double spring = 0, spring_rest = 0, cubic_spring = 0;
    double stop_position = 0, stop_stiffness = 0;
    std::vector<Wave> cogging;
    double disturbance = 0, disturbance_Hz = 0, disturbance_phase = 0;
    double walk_per_root_s = 0; // a load that wanders: standard deviation after one second
    // From asked to delivered torque
    std::vector<Wave> ripple;
    double gain = 1, lag = 0, dead_time = 0, delivered_limit = 0;
    // Inertia
    std::optional<Modes> modes;
    double gap = 0, load_share = 0;                // behind the gap
    double contact_rad_s = 0, contact_damping = 0; // of the load on the closed gap, motor clamped
    Wave inertia_wave;
    double jump_time = 0, jump_factor = 1; // of the inertia, at a moment
    // Sensor
    double eccentricity = 0, eccentricity_phase = 0;
    double quantum = 0; // 0: an ideal encoder
    // Loop, eq. (16); integral_time 0: position P, speed P
    double position_gain = 0, speed_gain = 0, integral_time = 0, period = 0, torque_limit = 0;
    // White torque that disturbs the axis, standard deviation, held for a period
    double torque_noise = 0;
};

using Reference = std::vector<double>; // one value per control period, from rest at zero

struct Record {
    std::vector<double> reference, asked, measured; // what a drive can record
    std::vector<double> position, velocity;         // the truth at the same instants
    // Means over the period that follows; direction: of dry friction, as a share of what it may be
    // (between −1 and 1 while the axis sticks):
    std::vector<double> mean_velocity, acceleration, direction, delivered, noise;
    std::vector<double> stuck; // share of the period
    bool limited = false;      // the loop met its torque limit
    std::size_t size() const { return asked.size(); }
};

struct RunOptions {
    int substeps = 100;
    std::uint64_t seed = 1;
};

Record run(const World& world, const Reference& reference, const RunOptions& options = {});

// Without a loop: a torque per period from a state of motion, for checks against closed forms.
struct Start {
    double position = 0, velocity = 0;
};
Record run_open(const World& world, const std::vector<double>& torque, const Start& start,
                const RunOptions& options = {});

// Writes an effect of the catalogue, or one that is in no catalogue (cubic_spring, cubic_drag,
// random_walk, inertia_jump), into the world.
void apply(World& world, const servoid::EffectTerm& effect);

} // namespace blind
