// The continuous axis: eq. (6) or eq. (7), friction with real sticking, and every effect of the
// catalogue. Two engines stand behind it; the description decides which (axis_engine.hpp).
//
// Exact, where the axis is piecewise linear: between two events (a change of the held torque, of
// the sign of the velocity, sticking, breaking away) the axis is linear and its input constant, so
// it is propagated by the exact matrix exponential. Events inside a step are found by halving:
// exp(A·h/2^k) is tabulated for every k, so each half is exact too, and an event is located within
// h/2^24. General, for everything else: a Runge-Kutta pair with step control between located
// events.
#pragma once

#include "model/model.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace servoid {

// Eq. (7) of the paper. Three independent numbers: the rigid inertia J and both frequencies; it is
// not a two-mass system whose motor inertia is known.
struct ElasticLoad {
    double antiresonance_rad_s = 0, resonance_rad_s = 0;
    double antiresonance_damping = 0, resonance_damping = 0;
};

// Where the axis is: the arguments of a law that is a plain function.
struct AxisPoint {
    double time_s = 0, position = 0, velocity = 0;
    double torque = 0;       // delivered, N·m or N
    double acceleration = 0; // of the motor, where AxisDescription::reads_acceleration says so
};

// Bristle friction (Dahl): F' = σ v (1 − F sgn v / F_c), F_c = torque, σ = stiffness.
struct Bristle {
    double stiffness = 0, torque = 0;
};

// A gap between motor and load: the load coasts inside it and meets either face inelastically.
struct Gap {
    double width = 0, load_share = 0; // share of the inertia that is behind the gap
};

// J(θ) = J·(1 + fraction·cos(order·θ + phase)), with its ½·J'·v² term.
struct InertiaWave {
    double fraction = 0, order = 0, phase = 0; // order in rad per rad or rad per m
};

// What becomes of the asked torque on its way to the motor, in this order: limit, gain and ripple,
// lag, dead time.
struct DriveChain {
    double limit = 0; // 0: none
    double gain = 1;
    double lag_s = 0; // through 1/(τs+1)
    double dead_time_s = 0;
    std::vector<std::function<double(double position)>>
        ripple; // each adds this share of the torque
};

// What the simulator integrates. Effects write into it (Effect::add_to). Torques oppose the motor.
struct AxisDescription {
    Motion kind = Motion::rotary;
    double inertia = 0; // kg·m² or kg
    double viscous_forward = 0, viscous_reverse = 0;
    double coulomb_forward = 0, coulomb_reverse = 0;
    double constant_torque = 0;
    std::optional<ElasticLoad> elastic;
    std::optional<Bristle> bristle;
    std::optional<Gap> backlash;
    std::optional<InertiaWave> inertia_wave;
    double load_friction = 0; // μ·|delivered torque|·sgn v, sticks like Coulomb friction
    // On top of Coulomb friction, as a size against the motion: Stribeck.
    std::vector<std::function<double(double speed)>> sliding_extra;
    // Any other law, opposing the motor: springs, drag, cogging, what depends on time.
    std::vector<std::function<double(const AxisPoint&)>> opposing;
    // One of them depends on the acceleration, which is then solved for with what it causes.
    bool reads_acceleration = false;
    std::function<double(double time_s)> friction_factor; // empty: 1
    DriveChain drive;
    std::function<double(double position)>
        sensor_error; // added to the measured position; may be empty
};

class Axis {
  public:
    // step_s: the time over which each torque is held. Throws std::invalid_argument on a
    // non-positive inertia or step.
    Axis(const AxisDescription& description, double step_s);
    ~Axis();
    Axis(Axis&&) noexcept;
    Axis& operator=(Axis&&) noexcept;

    // Holds the asked torque [N·m or N] for one step. Cost, exact engine: one 2x2 (eq. 6) or 4x4
    // (eq. 7) product, some fifty of them in a step with an event; general: 4 and more small steps.
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
