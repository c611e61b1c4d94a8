// What a bus went through while it was listened to, and what was made of it.
#pragma once

#include "can/frame.hpp"
#include "capture/capture.hpp"

#include <string>
#include <vector>

namespace servoid::can {

struct BusReport {
    long frames = 0;       // all that were seen
    long used = 0;         // that stand in a row
    long lost = 0;         // cycles of which a frame is missing
    long repeated = 0;     // the same once more
    long late = 0;         // more than half a period after their time
    long reordered = 0;    // after one that was sent later (seen by a counter or a device time)
    long short_frames = 0; // too few bytes for the map
    long errors = 0;       // error frames of the bus; of them:
    long bus_off = 0, restarted = 0, error_passive = 0, error_warning = 0;
    long dropped = 0;        // that the logger says it missed, or a live bus had no room for
    long resets = 0;         // of the drive, while it was listened to
    long interface_down = 0; // how often, while a live bus was heard
    double period_s = 0;
    double jitter_s = 0; // rms of the arrivals about the fitted clock
    std::string clock; // what gave the instants: "SYNC", "SYNC, counted", "counter", "device time",
                       // "arrival"
};

// An error frame and what it says.
void count_error(const Frame& frame, BusReport& report);

struct BusCaptures {
    std::vector<Capture> captures; // one for each stretch without a gap
    BusReport report;
};

} // namespace servoid::can
