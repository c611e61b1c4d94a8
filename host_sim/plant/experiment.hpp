// What the simulated drive is asked to do.
//
// Text form: `kind:key=value,key=value` or the path of a .toml file with the same keys. Every key
// has a default. Kinds and keys (SI, Hz; position in rad or m):
//   sine            frequency_Hz amplitude periods
//   multisine       from_Hz to_Hz step_Hz amplitude periods seed   (random phases)
//   trapezoid       stroke velocity acceleration dwell cycles      (there and back)
//   constant_speed  velocity duration                              (with a soft start)
//   speeds          from to count duration   (count speeds, both ways, each a segment)
//   staircase       stroke from to count acceleration cycles   (there and back at each of count
//                   speeds: many speeds in one move whose travel is known)
// Keys of every kind: torque_noise (standard deviation per sample of a torque that disturbs the
// axis); rest (seconds before the move); start (position where the axis stands before the move,
// in the model's coordinates: springs, arms, stops and cogging have a place).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace servoid {

struct Experiment {
    std::string text; // how it was written, for the capture's metadata
    double duration_s = 0;
    double torque_noise = 0; // N·m or N, per sample
    double start = 0;        // rad or m: where the axis stands before the move
    std::optional<double> period_s;
    std::function<double(double)> position_ref; // rad or m against time; its first value is `start`
    std::function<int(double)> segment;         // empty: no segments
};

// Throws UsageError (text) or FileError (file): unknown kind or key, a value out of range.
Experiment parse_experiment(const std::string& text_or_path);

} // namespace servoid
