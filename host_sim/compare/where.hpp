// Where the model fails: the residual's power by regime of the motion.
#pragma once

#include "compare/motion.hpp"

#include <string>
#include <vector>

namespace servoid {

struct Regime {
    std::string group;         // "regime", "direction", "frequency", "position order", "time"
    std::string regime;        // "reversal", "cruise 0.1…0.2 m/s", "order 1 per 2.5 mm", ...
    double residual_share = 0; // of the residual's power
    double sample_share = 0;   // of the samples, of the band, or what chance would explain
};

// The regimes of one group add up to 1, except the orders, which are separate lines. Groups come in
// the order above, members of a group by their place (time, frequency) or by what they hold.
std::vector<Regime> where_it_fails(const PreparedMotion& motion, const Eigen::VectorXd& residual);

} // namespace servoid
