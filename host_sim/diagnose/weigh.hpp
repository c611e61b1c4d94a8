// How probable each candidate is.
#pragma once

#include "diagnose/diagnose.hpp"

namespace servoid {

// Fills in the probabilities and sorts the candidates, best first. A candidate whose gain noise
// could make is compared with twins in which nothing is missing (twin.hpp).
void weigh(Diagnosis& diagnosis, Assembler& assembler);

} // namespace servoid
