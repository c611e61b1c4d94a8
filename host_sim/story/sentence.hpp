// The verdict for people.
#pragma once

#include "diagnose/diagnose.hpp"

#include <string>

namespace servoid {

// One or two sentences. diagnosis, refinement: nullptr where they were not asked for.
std::string sentence(const Comparison& comparison, const Diagnosis* diagnosis,
                     const Refinement* refinement);

} // namespace servoid
