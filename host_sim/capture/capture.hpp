// What was measured: one Capture whatever file it came from. Plain data, SI, never repaired.
// Formats and rules: SPEC.md, "Capture".
#pragma once

#include "common/progress.hpp"
#include "model/model.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace servoid {

// A column that was not recorded is an empty vector; all others have time_s.size() rows.
struct Capture {
    std::string path; // for messages only
    std::map<std::string, std::string> metadata;

    std::vector<double> time_s;
    std::vector<double> torque_ref; // N·m or N: what the drive asked for
    std::vector<double> torque;     // measured
    std::vector<double> position;   // rad or m
    std::vector<double> velocity;   // rad/s or m/s
    std::vector<double> position_ref;
    std::vector<double> velocity_ref;
    std::vector<double> load_position;
    std::vector<int> segment;

    // Both torques are in A, because neither the file nor the model gave a torque constant: inertia
    // then comes out in A·s²/rad and the unit is said wherever a number is shown.
    bool torque_in_ampere = false;
    bool linear = false; // the columns were m and N

    double sample_time_s = 0; // median step
    bool uniform = true;      // false: the capture carries its own, uneven times
    bool ref_held = true;     // `*_ref` is held until the next row (half a sample of hold)
    double torque_delay_s = 0;
    std::optional<double> period_s;
    // The step of the column: of the sensor where one is seen, else the last digit that the file
    // prints; 0 where the numbers carry all their digits and show no step.
    double position_quantum = 0; // rad or m
    double velocity_quantum = 0;
    double torque_quantum = 0; // of the measured torque, else of the reference

    std::size_t rows() const { return time_s.size(); }
    bool has_position() const { return !position.empty(); }
};

// How foreign columns are named and scaled (SPEC.md, "Map file").
struct SignalMap {
    struct Signal {
        std::string column;
        double scale = 1.0;
        double offset = 0.0; // SI value = scale * column + offset
        long line = 0;
    };
    std::string path;
    std::map<std::string, Signal> signals; // key: capture column without unit, e.g. "force_ref"
    std::map<std::string, std::string> metadata; // [metadata] table: as `# key = value` in a CSV
};

SignalMap read_signal_map(const std::string& path);

// Scales that a capture in A, per mille or counts needs; taken from the model where there is one,
// else from the metadata. 0: not known.
struct CaptureScales {
    double rated_torque = 0;
    double torque_constant = 0;
    double position_per_count = 0;
    bool linear = false; // the axis, where the columns (A, counts) leave it open
};
CaptureScales scales_of(const Model& model);

// Reads .csv or .mat by the file's ending. Throws FileError (`file:line: reason`).
Capture read_capture(const std::string& path, const CaptureScales& scales = {},
                     const SignalMap* map = nullptr, const Progress& progress = {});

// The capture as CSV text in the stable format: header, metadata, rows that read back the same.
std::string format_capture_csv(const Capture& capture);

} // namespace servoid
