// The simulated drive: a continuous axis, an encoder that counts, and the core's own loop (Fig. 2).
//
// One control period: read the counts at t_k, compute the torque from them and the reference (sid_loop),
// hold it until t_{k+1} while the axis moves. A row of a capture is what was known at t_k.
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
    double torque_noise = 0; // N·m or N per sample, a torque that disturbs the axis
    double full_torque = 0;  // what the core calls rated where the model does not say; 0: chosen
};

struct DriveSample {
    double reference = 0, torque = 0, position = 0; // rad or m, N·m or N; position as counted
    int32_t counts = 0, torque_pu_q20 = 0;
};

class SimulatedDrive {
  public:
    // Throws UsageError where the model has no controller.
    SimulatedDrive(const Model& model, const DriveOptions& options);

    DriveSample step(double reference);          // rad or m
    DriveSample step_q8(int32_t reference_q8);   // the core's unit

    int32_t counts() const; // where the encoder stands now
    double sample_time_s() const { return sample_time_s_; }
    double position_per_count() const { return per_count_; }
    double full_torque() const { return full_torque_; } // N·m or N of 1.0 per unit
    bool saturated() const { return loop_.saturated_samples > 0; }
    // Starts in motion: the loop's memory is filled as if the axis had moved like that before.
    void set_state(double position, double velocity);

  private:
    double sample_time_s_, per_count_, full_torque_;
    Axis axis_;
    sid_loop_t loop_{};
    std::mt19937_64 random_;
    std::normal_distribution<double> noise_;
    bool noisy_;
};

} // namespace servoid
