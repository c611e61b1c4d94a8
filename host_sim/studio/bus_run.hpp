// A drive on the CAN bus, run by a studio.
#pragma once

#include "can/telemetry_table.hpp"
#include "node/go_and_move.hpp"

#include <functional>
#include <string>
#include <vector>

namespace servoid::studio {

struct BusSetup {
    std::string interface; // empty: no bus
    LinkOptions link;
    Limits limits;
};

// What has arrived so far.
struct BusView {
    long rows = 0;
    double seconds = 0; // of the drive's time, since the start of the move
    can::LiveRows live;
};
using OnBus = std::function<bool(const RunProgress&, const BusView&)>; // whether to go on

struct BusRun {
    std::vector<Capture> captures; // a stretch without a gap each; what was heard in any case
    std::string fault;             // why it did not run to its end, or ""
};

// Claims the drive, makes the move, gives it back. on_bus is called some ten times a second; where
// it answers false, the drive holds its axis and the run ends there. A bus that breaks is a fault.
BusRun run_on_bus(const BusSetup& setup, const Experiment& experiment, const OnBus& on_bus);

} // namespace servoid::studio
