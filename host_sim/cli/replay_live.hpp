// What replay hears on a live bus.
#pragma once

#include "can/bus_log.hpp"
#include "cli/app.hpp"

#include <optional>
#include <string>

namespace servoid::cli {

struct LiveOptions {
    std::string interface, log; // log: where to keep what was heard
    std::optional<double> for_s;
    double idle_s = 2, wait_s = 10;
};

void add_live_options(const Verb& verb, LiveOptions& options);

// Listens until the move is over; SIGINT and SIGTERM end it too. Where the bus fails, what came
// before is saved (log; out: the longest stretch without a gap as CSV, where there is one) and
// BusError goes on.
can::BusCaptures record_live(const LiveOptions& options, const can::FrameMap& map,
                             const CaptureScales& scales, const Output& output,
                             const std::string& out);

} // namespace servoid::cli
