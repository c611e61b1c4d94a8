// What stands behind an Axis: one of two integrators with the same face.
#pragma once

#include "plant/axis.hpp"

#include <memory>

namespace servoid {

class Axis::Engine {
  public:
    virtual ~Engine() = default;
    virtual void step(double torque) = 0;
    // After position, velocity and stuck were set from outside: hidden states follow (the load
    // moves with the motor, nothing is bent, no torque is on its way).
    virtual void reset() = 0;

    double position = 0, velocity = 0;
    bool stuck = true;
};

// Exact, some thousand times real time: inertia, viscous and Coulomb friction, constant torque,
// elastic load; limit, gain, lag and dead time of the torque.
bool is_linear(const AxisDescription& axis);
std::unique_ptr<Axis::Engine> make_linear_engine(const AxisDescription& axis, double step_s);

// Everything, by adaptive Runge-Kutta steps between located events.
struct GeneralOptions {
    int substeps = 4;        // at least so many in a step
    double tolerance = 1e-9; // of a substep, as a share of the velocity
};
std::unique_ptr<Axis::Engine> make_general_engine(const AxisDescription& axis, double step_s,
                                                  const GeneralOptions& options = {});

} // namespace servoid
