// The simulated drive: a continuous axis, an encoder that counts, and the core's own loop (Fig. 2).
//
// One control period: read the counts at t_k, compute the torque from them and the reference
// (sid_loop), hold it until t_{k+1} while the axis moves. A row of a capture is what was known at
// t_k.
#pragma once

#include "model/model.hpp"
#include "plant/axis.hpp"
#include "servoid/sid_loop.h"

#include <cstdint>
#include <random>

namespace servoid {

// The axis that a model describes: its inertia and every effect written in.
AxisDescription axis_of(const Model& model);

struct DriveOptions {
    unsigned long seed = 1;
    double torque_noise = 0;   // N·m or N per sample, a torque that disturbs the axis
    double position_noise = 0; // rad or m, white, added before the encoder counts
    double full_torque = 0;    // what the core calls rated where the model does not say; 0: chosen
};

struct DriveSample {
    double reference = 0, torque = 0, position = 0; // rad or m, N·m or N; position as counted
    int32_t counts = 0, torque_pu_q20 = 0;
};

class SimulatedDrive {
  public:
    // Throws UsageError where the model has no controller.
    SimulatedDrive(const Model& model, const DriveOptions& options);
    // With an axis of its own in place of the model's.
    SimulatedDrive(const Model& model, const DriveOptions& options, const AxisDescription& axis);

    DriveSample step(double reference);        // rad or m
    DriveSample step_q8(int32_t reference_q8); // the core's unit

    // What the encoder says now: the position, its error (AxisDescription::sensor_error), its
    // noise.
    int32_t counts() const;
    double sample_time_s() const { return sample_time_s_; }
    double position_per_count() const { return per_count_; }
    double full_torque() const { return full_torque_; } // N·m or N of 1.0 per unit
    bool saturated() const { return loop_.saturated_samples > 0; }
    // Starts in motion: the loop's memory is filled as if the axis had moved like that before.
    void set_state(double position, double velocity);
    // Fills the integrator so that the first step with this reference asks for this torque.
    void set_first_torque(double reference, double torque);

  private:
    void read();
    int32_t to_q8(double reference) const;

    double sample_time_s_, per_count_, full_torque_;
    std::function<double(double)> sensor_error_;
    Axis axis_;
    sid_loop_t loop_{};
    double torque_per_count_; // asked for one count of speed error, without the integrator
    std::mt19937_64 random_;
    std::normal_distribution<double> noise_;
    bool noisy_;
    double position_noise_, reading_noise_ = 0; // standard deviation; of the next sample
    std::mt19937_64 position_random_;           // its own, so that neither noise changes the other
    std::normal_distribution<double> unit_noise_{0, 1};
};

} // namespace servoid
