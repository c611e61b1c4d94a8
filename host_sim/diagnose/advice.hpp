// What to do next, in words.
#pragma once

#include "diagnose/diagnose.hpp"

namespace servoid {

std::string advice_for(const Diagnosis& diagnosis);

} // namespace servoid
