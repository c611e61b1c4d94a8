// Options that say what the frames of a bus mean.
#pragma once

#include "can/frame_map.hpp"
#include "cli/app.hpp"

#include <map>

namespace servoid::cli {

struct BusOptions {
    std::string map, dbc, profile, sync;
    std::map<std::string, std::string> signals; // of the DBC: "torque" to "Message.Signal[:unit]"
    std::vector<std::string> objects = can::default_objects();
    int node = 1, tpdo = 1;
    std::optional<double> period_s; // stated; beats that of the map

    can::FrameMap frame_map() const;
};

// map: where --map of the verb is kept.
void add_bus_options(const Verb& verb, BusOptions& options);

} // namespace servoid::cli
