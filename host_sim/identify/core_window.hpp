// The firmware core's bin run over samples of a host capture.
#pragma once

#include "common/scaled.hpp"
#include "servoid/sid_inertia.h"

#include <Eigen/Core>

namespace servoid {

// What one unit of the core means in SI: torque 2^-20 of this many N·m (or N), one count, one
// sample.
struct CoreScale {
    double full_torque = 1;        // N·m or N that the core calls "rated"
    double position_per_count = 1; // rad or m
    double sample_time_s = 1;
};

// The smallest rated torque and count that the window's signals fit into. A known rated torque and
// encoder step are used where the signals fit them, so that the core sees what a drive would see.
CoreScale choose_scale(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                       double rated_torque, double position_quantum, double sample_time_s);

// One window through sid_bin and sid_inertia; in SI.
struct WindowResult {
    double inertia = 0, viscous = 0, position_amplitude = 0, torque_amplitude = 0;
    sid_reason_t reason = SID_NOT_RUN;
    sid_bin_t bin{};
};

struct WindowTask {
    CoreScale scale;
    double frequency_Hz = 0;
    Eigen::Index first = 0, count = 0; // samples
    sid_bin_method_t method = SID_BIN_CUBIC;
    sid_torque_timing_t timing = SID_TORQUE_HELD_NEXT;
};

WindowResult run_window(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                        const WindowTask& task);

// The same of a torque that may lie either way: the core gives no inertia that is not positive, so
// the torque is turned round and the answer with it.
WindowResult project(const Eigen::VectorXd& torque, const Eigen::VectorXd& position,
                     const WindowTask& task);

} // namespace servoid
