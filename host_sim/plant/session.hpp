// The core's session run on the simulated drive, through the HAL (sid_hal.h).
#pragma once

#include "plant/drive.hpp"
#include "servoid/sid_identify.h"

#include <functional>
#include <vector>

namespace servoid {

// One frequency of a plan, as an engineer writes it.
struct PlannedSine {
    double frequency_Hz = 0;
    double amplitude = 0; // rad or m of reference
};

struct SessionOptions {
    double settle_periods = 8, window_periods = 2; // the paper's: 8th to 10th period
    double ramp_periods = 0;                       // the paper's: a sine from rest
    int windows = 1; // a leg; from two on there is a standard deviation
    sid_bin_method_t method = SID_BIN_CUBIC;
};

// One frequency's answer in SI.
struct SessionResult {
    double frequency_Hz = 0, inertia = 0, viscous = 0;
    double inertia_std = 0, viscous_std = 0; // of the mean over the windows
    bool std_known = false;
    double position_amplitude = 0, torque_amplitude = 0;
    sid_reason_t reason = SID_NOT_RUN;
};

// What happened in each control period: for captures and for tests. May be empty.
using SessionObserver = std::function<void(const DriveSample&)>;

std::vector<SessionResult> run_session(SimulatedDrive& drive, const std::vector<PlannedSine>& plan,
                                       const SessionOptions& options,
                                       const SessionObserver& observer = {});

} // namespace servoid
