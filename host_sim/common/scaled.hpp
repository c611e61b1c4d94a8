// Between double and the core's numbers of any magnitude.
#pragma once

#include "servoid/sid_scaled.h"

#include <cmath>

namespace servoid {

inline sid_scaled_t to_scaled(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return sid_scaled_make(std::llround(std::ldexp(mantissa, 62)), exponent - 62);
}

inline double to_double(sid_scaled_t number) {
    return std::ldexp(number.mantissa, number.exponent);
}

} // namespace servoid
