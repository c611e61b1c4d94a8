// What a recording must satisfy before it is a Capture. Nothing here repairs anything: a check
// passes or throws FileError with the line.
#pragma once

#include "capture/raw_table.hpp"

namespace servoid {

struct Timing {
    double sample_time_s = 0;
    bool uniform = true;
};

// Times that increase, are uniform or clearly carry their own steps, have no gap, and agree with
// the metadata.
Timing check_times(const RawTable& table);

// The step of a column in its own units, see Capture::position_quantum.
double find_quantum(const std::vector<double>& values, const Printing& printing);

// Positions that jump back by a whole turn or by the range of a counter. `quantum` in file units.
void check_unwrapped(const RawTable& table, const RawColumn& column, double turn, double quantum);

// Position and velocity, both SI, must be derivative of each other within what a filter changes.
void check_velocity_unit(const RawTable& table, const std::vector<double>& time_s,
                         const std::vector<double>& position, const std::vector<double>& velocity);

} // namespace servoid
