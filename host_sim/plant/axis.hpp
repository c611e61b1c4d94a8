// The continuous axis: eq. (6) or eq. (7), friction with real sticking, constant torque.
//
// Between two events (a change of the held torque, of the sign of the velocity, sticking, breaking
// away) the axis is linear and its input constant, so it is propagated by the exact matrix
// exponential. Events inside a step are found by halving: exp(A·h/2^k) is tabulated for every k, so
// each half is exact too, and an event is located within h/2^24.
#pragma once

#include <memory>
#include <optional>

namespace servoid {

// Eq. (7) of the paper. Three independent numbers: the rigid inertia J and both frequencies; it is
// not a two-mass system whose motor inertia is known.
struct ElasticLoad {
    double antiresonance_rad_s = 0, resonance_rad_s = 0;
    double antiresonance_damping = 0, resonance_damping = 0;
};

// What the simulator integrates. Effects write into it (Effect::add_to). Torques oppose the motor.
struct AxisDescription {
    double inertia = 0; // kg·m² or kg
    double viscous_forward = 0, viscous_reverse = 0;
    double coulomb_forward = 0, coulomb_reverse = 0;
    double constant_torque = 0;
    std::optional<ElasticLoad> elastic;
};

class Axis {
  public:
    // step_s: the time over which each torque is held. Throws std::invalid_argument on a
    // non-positive inertia or step.
    Axis(const AxisDescription& description, double step_s);
    ~Axis();
    Axis(Axis&&) noexcept;
    Axis& operator=(Axis&&) noexcept;

    // Holds the motor torque [N·m or N] for one step. Cost: one 2x2 (eq. 6) or 4x4 (eq. 7) product,
    // some fifty of them in a step with an event.
    void step(double torque);

    double position() const; // rad or m
    double velocity() const; // rad/s or m/s
    bool stuck() const;      // held by Coulomb friction
    void set_state(double position, double velocity);

    class Engine; // one per order of the linear part

  private:
    std::unique_ptr<Engine> engine_;
};

} // namespace servoid
