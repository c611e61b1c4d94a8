// What a bus was like, as JSON and as text.
#pragma once

#include "can/bus_log.hpp"
#include "cli/app.hpp"

namespace servoid::cli {

Json bus_json(const can::BusReport& bus);
// live: what was dropped was dropped here, else by the logger.
void print_bus(const Output& out, const can::BusCaptures& heard, bool live);

// The stretch that tells most.
const Capture& longest(const std::vector<Capture>& captures);

} // namespace servoid::cli
