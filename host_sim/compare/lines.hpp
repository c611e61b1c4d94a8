// Odd and even lines: what kind of nonlinearity a periodic move shows, before any law is named.
//
// A move whose reference excites only odd multiples of its base frequency (a sine, there and back
// on the same profile, an odd multisine) is the same with opposite sign half a period later. An odd
// law (friction, x³) keeps that symmetry and answers at odd lines only; what answers at even lines
// depends on the direction or the place (gravity, cogging off its symmetry, an asymmetry). Odd
// lines that are not excited, detection lines, show the odd laws apart from the linear ones. What
// repeats sits on the lines, so what lies between them is noise.
//   Pintelon, Schoukens, System Identification, 2nd ed., Wiley 2012, chapter 4
#pragma once

#include "compare/motion.hpp"

#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <vector>

namespace servoid {

// As ratio to the torque's rms over the used samples, as torque_error; NaN: not applicable.
struct LineKinds {
    double excited = NAN;
    double odd = NAN;  // odd lines that are not excited
    double even = NAN; // even lines from 2 on; line 0 is the mean, which a constant torque makes
};

struct LineCounts {
    int excited = 0, odd = 0, even = 0;
    int all() const { return excited + odd + even; }
};

struct Lines {
    double base_Hz = NAN; // NaN where the captures differ in it
    LineKinds residual, torque;
    LineKinds noise;                  // what noise puts on these lines, from its power beside them
    double between = NAN, mean = NAN; // of the residual: noise on all lines together; line 0
    LineCounts counts;                // of the first capture, up to where the band limit stops
};

// What the model leaves of one capture, and how many periods at its end hold no transient.
struct PeriodicResidual {
    const PreparedMotion& motion;
    const Eigen::VectorXd& residual; // on the grid
    int periods = 0;                 // NoiseFloor::periods
};

// All captures together whose reference (position, else velocity, else the torque) repeats and
// excites odd lines only; powers add up. Nothing where there is none. Points at standstill count as
// zero, as do those half a period away, which keeps odd and even apart.
std::optional<Lines> lines_of(const std::vector<PeriodicResidual>& captures);

} // namespace servoid
