// A signal as the page draws it: 16 bits a value, the least and the most of each bucket where there
// are more values than anyone can see. No peak is lost: every value lies between the two.
#pragma once

#include "answers/json.hpp"

#include <span>

namespace servoid {

struct SeriesAxis {
    double start_s = 0, step_s = 0;
};

// null for no values. most: of values or buckets. A value that is not finite is a gap.
Json series_json(std::span<const double> values, const SeriesAxis& axis, size_t most);

} // namespace servoid
