// The moves among which the next experiment is chosen: what parse_experiment offers, over strokes,
// speeds and frequencies that the axis is known to bear.
#pragma once

#include "diagnose/move_limits.hpp"
#include "plant/experiment.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace servoid {

struct Move {
    std::string kind;
    std::vector<std::pair<std::string, double>> keys;
    std::string effort;     // the key that makes it gentler: amplitude or acceleration
    double most_effort = 1; // times that key: as far as the travel allows, where the loop lags
};

// Gentle ones first among those of a kind, and what rarely decides last. inertia: for how much
// acceleration the torque is good for.
std::vector<Move> menu_of(const MoveLimits& limits, double inertia);

// The text for parse_experiment, with the effort's key times `effort`, about the middle of the
// travel; nothing where the move would last too long.
std::optional<std::string> text_of(const Move& move, double effort, const MoveLimits& limits);

} // namespace servoid
