// The asked torque on its way to the motor: limit → gain·(1 + ripple) → lag → dead time.
//
// What leaves the lag is kept as a list of stretches on each of which it is known in closed form
// (the lag's answer to a parabola), so the delayed torque can be read at any instant and no dead
// time needs to be a multiple of anything. Without ripple a stretch is a control period and exact;
// with ripple it is a substep of the integration, along which the ripple is a parabola.
#pragma once

#include "plant/axis.hpp"

#include <array>
#include <deque>

namespace servoid {

// A substep: seconds into the current period, and the position at its beginning, middle and end.
struct Stretch {
    double at = 0, length = 0;
    std::array<double, 3> position{};
};

class TorqueChain {
  public:
    TorqueChain(const DriveChain& drive, double step_s);

    // Where inside a period a change of the asked torque arrives; 0: at its beginning.
    double arrival() const { return arrival_; }
    // The torque now depends on where the axis was: open() must predict, close() tell.
    bool remembers_motion() const { return remembers_motion_; }

    void reset();
    void ask(double torque); // a control period begins
    // Before a substep is tried (again, where the last one was not closed).
    void open(const Stretch& predicted);
    void close(const Stretch& real);
    // Inside the open substep.
    double delivered(double at, double position) const;

  private:
    struct Piece {
        long period = 0;
        double start = 0, length = 0, output = 0; // output of the lag at the start
        double c0 = 0, c1 = 0, c2 = 0;            // its input: c0 + c1·t + c2·t²
    };
    double since(const Piece& piece, double at) const;
    double value(const Piece& piece, double t) const;
    double ripple(double position) const;
    Piece piece_of(const Stretch& stretch) const;
    double last_output() const;

    DriveChain drive_;
    double step_s_, arrival_ = 0;
    bool direct_, remembers_motion_;
    long period_ = 0;
    double asked_ = 0;
    Stretch open_;
    Piece trial_; // of the open substep, where the motion is remembered
    std::deque<Piece> past_;
};

} // namespace servoid
