// Where the model fails: the residual's power by regime of the motion.
#pragma once

#include "compare/motion.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace servoid {

struct Regime {
    std::string group;         // "regime", "direction", "frequency", "position order", "time", and
                               // those of where_by_value
    std::string regime;        // "reversal", "cruise 0.1…0.2 m/s", "order 1 per 2.5 mm", ...
    double residual_share = 0; // of the residual's power
    double sample_share = 0;   // of the samples, of the band, or what chance would explain
    // Of where_by_value only: the edges of the bin, and the mean of the residual in it.
    double from = NAN, to = NAN, mean_residual = NAN;
};

// The regimes of one group add up to 1, except the orders, which are separate lines. Groups come in
// the order above, members of a group by their place (time, frequency) or by what they hold.
std::vector<Regime> where_it_fails(const PreparedMotion& motion, const Eigen::VectorXd& residual);

// The regime of the motion ("reversal", "braking", ...) at every instant of the grid.
std::vector<std::string> motion_regimes(const PreparedMotion& motion);

} // namespace servoid
