// The part of the torque error that no deterministic model of the axis could explain.
#pragma once

#include "compare/motion.hpp"

namespace servoid {

struct NoiseFloor {
    double ratio = 0;              // of ‖T‖, like torque_error
    bool from_repetition = false;  // else from the quantisation of the sensors
    double repeatable_share = NAN; // of the residual's power; NaN where nothing repeats
    int periods = 0;               // whole periods that were used
};

// residual: T − T̂ on the grid. With whole periods: the power of what differs between them, with
// P/(P−1) for the mean that was taken from the same P periods. A start transient (leading periods
// that differ from the rest by more than three times what the rest differ) is left out.
// With less than two, the same from instants that are a period apart. Never below the noise of the
// measured motion and torque carried through the inertia and the band limit, which is all there is
// where nothing repeats.
NoiseFloor noise_floor(const PreparedMotion& motion, const Eigen::VectorXd& residual,
                       double inertia);

} // namespace servoid
