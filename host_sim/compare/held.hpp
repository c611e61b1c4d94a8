// Where friction holds the axis.
//
// At a reversal an axis with Coulomb friction may stand for some milliseconds. Friction is then
// whatever balances the torque, and no law of the motion says how much: such instants are taken out
// of torque and model alike, before any filter. T·m = Σ law·m holds at every instant for any
// weight m(t), so nothing else changes.
#pragma once

#include "capture/capture.hpp"

#include <Eigen/Core>

#include <vector>

namespace servoid {

struct Interval {
    double from_s, to_s;
};

// Stretches in which an evenly sampled position stays within `within` for much longer than the same
// way takes before or after it, and for at least `shortest_s`. Times from the first sample. The
// turning point of a slow motion may be among them.
std::vector<Interval> held_intervals(const Eigen::VectorXd& position, double step_s, double within,
                                     double shortest_s);

// The weight of such stretches: 1 inside, 0 outside, smooth over `ramp_s` before and after.
class HeldWeight {
  public:
    HeldWeight() = default;
    // Widens each interval by margin_s on both sides; those that touch become one.
    HeldWeight(const std::vector<Interval>& intervals, double margin_s, double ramp_s);
    bool empty() const { return intervals_.empty(); }
    double at(double time_s) const;
    // At start_s + i·step_s.
    Eigen::VectorXd at(double start_s, double step_s, Eigen::Index count) const;

  private:
    std::vector<Interval> intervals_; // in order, more than two ramps apart
    double ramp_s_ = 0;
};

} // namespace servoid
