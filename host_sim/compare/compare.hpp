// How far a model and its measurements are apart, and where.
#pragma once

#include "compare/homing.hpp"
#include "compare/lines.hpp"
#include "compare/noise_floor.hpp"
#include "compare/where.hpp"
#include "model/model.hpp"

#include <optional>
#include <span>
#include <vector>

namespace servoid {

// Closed-loop simulation with the recorded reference against the record.
struct LoopError {
    double torque_error = 0;   // ‖T − T̂‖/‖T‖
    double position_error = 0; // ‖θ − θ̂‖/‖θ‖
};

struct Comparison {
    double torque_error = 0; // ‖T − T̂‖/‖T‖, both through the same band limit
    NoiseFloor floor;
    std::optional<LoopError> loop; // none without a controller or a position reference
    std::vector<Regime> where;     // where_it_fails, then where_by_value
    std::optional<Lines> lines;    // none without a periodic reference of odd lines
    std::optional<Estimate> lag_s; // of the torque, lag.hpp; none where the motion does not tell
    double residual_rms = 0;       // N·m or N, of the used samples
    long samples = 0;              // rows of the captures
    double samples_used_share = 0; // of the compared instants; the rest stands still
    double duration_s = 0;
    double band_Hz = 0;                           // the highest of the captures
    BandLimit band_limited_by = BandLimit::asked; // of that capture
    std::string torque_name, torque_unit;
    Homing homing; // against the model's phases
};

// The noise floor of all captures together, for the residual that this model leaves.
NoiseFloor noise_floor_of_all(const Model& model, const std::vector<PreparedMotion>& motions,
                              const Homing& homing = {});

// ‖T − T̂‖/‖T‖ of all captures together, as compare() says it, and nothing else. Captures from
// `first` on may have their own position zero.
double torque_error_of(const Model& model, const std::vector<PreparedMotion>& motions,
                       size_t first = 1);

// All captures together: powers add up. Those after the first may have their own position zero.
Comparison compare(const Model& model, const std::vector<PreparedMotion>& motions);

// prepare_motion for each capture; they must outlive what is made of them.
std::vector<PreparedMotion> prepare_all(std::span<const Capture> captures,
                                        const MotionOptions& options);
std::vector<PreparedMotion> prepare_all(std::vector<Capture>&&, const MotionOptions&) = delete;

// Residual T − T̂ on the grid of one capture.
Eigen::VectorXd residual_torque(const Model& model, const PreparedMotion& motion);

} // namespace servoid
