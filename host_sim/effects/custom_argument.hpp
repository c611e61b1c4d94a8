// A law on the command line: 'custom.cubic=k*theta^3' or 'custom.s=k*tanh(v/vs);vs=0.1'.
#pragma once

#include "model/model.hpp"

#include <string>

namespace servoid {

// Whether an EFFECT argument is meant as a law.
bool is_custom(const std::string& argument);

// Every name in the law that is no variable and no function is a parameter; it starts at 1 unless
// the list behind the law says otherwise. Throws UsageError.
EffectTerm parse_custom(const std::string& argument);

} // namespace servoid
