// Where the position zero of each capture lies: an encoder that was not homed between recordings.
//
// One offset per capture, position of the first capture = recorded position + offset, moves the
// phases of all waves of the position (cogging, ripple, gravity, ...) together: by κ·offset each.
// It is known modulo their period, so it says nothing of a spring's or a stop's place: those stay
// where they were recorded.
#pragma once

#include "effects/effect.hpp"

#include <Eigen/Core>

#include <vector>

namespace servoid {

struct Homing {
    std::vector<Estimate> offset; // per capture, rad or m; empty: all are 0
    double of(size_t capture) const { return capture < offset.size() ? offset[capture].value : 0; }
    // Whether an offset was adopted: exactly 0 is a capture whose zero is the first one's.
    bool moved(size_t capture) const { return of(capture) != 0; }
    std::vector<size_t> all_moved() const;
};

// A wave of the position among a model's coefficients.
struct PositionWave {
    Eigen::Index coefficient = 0; // A cos φ; A sin φ is the next
    double kappa = 0;             // rad per rad or m
};
std::vector<PositionWave> waves_of(const Model& model);
// κ of the fastest of them; 0 where there are none.
double fastest_wave(const std::vector<PositionWave>& waves);

// The model as a capture meets it whose zero lies at `offset`.
Model at_zero(Model model, double offset);

// The rows of one capture in an assembly.
struct Rows {
    Eigen::Index first = 0, count = 0;
};

// Turns each wave's two columns of one capture from the first capture's zero to one at `offset`.
void turn(Eigen::Ref<Eigen::MatrixXd> columns, const std::vector<PositionWave>& waves,
          double offset);

// How the torque moves with the offset (rows of the turned columns), the coefficients held.
Eigen::VectorXd offset_slope(const Eigen::Ref<const Eigen::MatrixXd>& turned,
                             const std::vector<PositionWave>& waves,
                             const Eigen::VectorXd& coefficients);

} // namespace servoid
