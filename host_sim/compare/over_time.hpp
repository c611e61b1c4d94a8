// The residual along the record, part by part.
#pragma once

#include "compare/homing.hpp"
#include "compare/motion.hpp"
#include "model/model.hpp"

#include <string>
#include <vector>

namespace servoid {

struct TimePart {
    size_t capture = 0;
    double from_s = 0, to_s = 0;
    double rms = 0;     // of the residual on its used instants, N·m or N; NaN where none is used
    std::string regime; // of the motion, which holds most of the residual there
};

// What a model leaves of all captures, one after the other, in about so many parts of equal length,
// fewer where there are fewer instants.
std::vector<TimePart> residual_over_time(const Model& model, const Homing& homing,
                                         const std::vector<PreparedMotion>& motions, int parts);

// rms of all parts together.
double rms_of(const std::vector<TimePart>& parts);

// The peaks among the parts: those above `factor` times the rms of all that have no larger
// neighbour, worst first, at most `most`.
std::vector<size_t> worst_of(const std::vector<TimePart>& parts, size_t most, double factor = 1.25);

} // namespace servoid
