// The equations of motion between two events, for every effect there is, and the events.
//
// Between events the body is in one mode: the motor slides forward or back or is stuck; the gap is
// open or closed at one face. Inside a mode the right-hand side is smooth but for the kinks of the
// laws that effects bring along. A mode ends where its margin turns negative.
//
// Friction at the motor, φ = friction_factor(t):
//   sliding  φ·(Coulomb(direction) + Σ sliding_extra(|v|) + D(direction)·|v|) + load_friction·|T|
//   held     up to the same at v = 0: breakaway is the peak of Stribeck's curve
//   bristle  φ·F. Dahl's law has no clock, so between two reversals F is a function of the
//   position,
//            F = sgn v·F_c + (F₀ − sgn v·F_c)·exp(−σ|x − x₀|/F_c): exact at any speed and step.
// A law that depends on the acceleration is given the one that it leads to (solved_slope).
// The body behind the motor is one of four:
//   rigid      J·w(θ), w = 1 + fraction·cos(order·θ + phase), with ½·J·w'(θ)·v²
//   flexible   eq. (7): the torque on it, times J/J(θ), through the flexible part of the linear
//   engine rigid gap  motor J(1 − s) and load J·s, each with w at its own position. The load coasts
//   in the
//              gap, meets a face without rebound (momentum is kept, energy is not), and leaves it
//              as soon as the face would have to pull.
//   sprung gap motor J_m = J(ωa/ωr)², load J_l = J − J_m, spring ωa²·J_l and damper 2ζaωa·J_l from
//              the faces of the gap on; inside it no force, and never one that pulls. Without the
//              gap this is eq. (7) with ζr = ζa·ωr/ωa: two masses have no room for another ζr.
#pragma once

#include "plant/axis_chain.hpp"

namespace servoid {

// p, w: q1, q2 of eq. (7); or with a gap how far the motor is ahead of the load, and the load's
// velocity.
struct BodyState {
    double x = 0, v = 0, p = 0, w = 0;
};

class Body {
  public:
    Body(const AxisDescription& axis, double step_s);

    TorqueChain chain;

    void reset(BodyState& state, double position, double velocity);
    void begin_period(double torque) { ++period_, chain.ask(torque); }
    // `at`: seconds into the period.
    BodyState slope(double at, const BodyState& y) const;
    // ≥ 0 as long as the mode lasts.
    double margin(double at, const BodyState& y) const;
    double margin(double at, const BodyState& y, const BodyState& slope) const;
    // The mode has ended here: stop the motor, open or close the gap.
    void leave_mode(double at, BodyState& y);
    // Which mode follows: slide or stay, press or part.
    void enter_mode(double at, BodyState& y);

    bool stuck() const { return slide_ == 0; }
    // Moving against the direction for which the friction was chosen.
    bool backwards(const BodyState& y) const { return directional_ && slide_ * y.v < 0; }
    // Errors of a state as a velocity, given the step.
    double velocity_of(const BodyState& error) const;

  private:
    enum class Kind { rigid, flexible, rigid_gap, sprung_gap };
    struct Acting {
        double torque = 0, free = 0, factor = 1; // delivered; all but friction at the motor; φ
    };

    void set_kind();
    void set_flexible_part(const ElasticLoad& e);
    void set_sprung_gap(const ElasticLoad& e);
    double factor(double time_s) const;
    Acting acting(double at, const BodyState& y, double acceleration = 0) const;
    BodyState slope_with(double at, const BodyState& y, double acceleration) const;
    BodyState solved_slope(double at, const BodyState& y) const;
    double bristle(double x) const;
    double level(int direction, double speed, const Acting& acting) const;
    double friction(double v, const Acting& acting) const;
    double wave(double x) const;
    double wave_slope(double x) const;
    double contact_torque(const BodyState& y) const;
    double on_friction(const BodyState& y, const Acting& acting) const;
    double pressing(const BodyState& y, const BodyState& slope) const;
    double gap_margin(const BodyState& y, const BodyState& slope) const;
    void set_slide(int slide, const BodyState& y);
    void break_away(double at, const BodyState& y);
    void collide(BodyState& y);
    BodyState flexible_slope(const BodyState& y, double torque) const;
    BodyState gap_slope(const BodyState& y, double torque) const;

    AxisDescription axis_;
    double step_s_;
    Kind kind_ = Kind::rigid;
    bool directional_ = false; // anything depends on the sign of the velocity
    double motor_ = 0, load_ = 0, half_gap_ = 0, spring_ = 0, damper_ = 0;
    double direct_ = 0, resonance_ = 0, resonance_damping_ = 0;
    std::array<double, 2> rest_{};

    long period_ = -1; // of step_s_, since the axis was made
    int slide_ = 0, contact_ = 0;
    double bristle_torque_ = 0, bristle_position_ = 0; // at the last reversal
};

} // namespace servoid
