// A smooth law that no catalogue names, where it explains as much as the law that was named.
#pragma once

#include "diagnose/diagnose.hpp"

#include <optional>
#include <string>

namespace servoid {

// A stop is also what a spring looks like that stiffens, and a drag with v² what one with v³ looks
// like. The candidate's rival is fitted in its place; the held-out errors of the same blocks are
// compared in pairs (Vuong, Econometrica 57, 1989).
struct Outside {
    std::string law; // as for a custom effect
    double z = 0;    // of the rival's gain over the candidate, in its standard errors
};

constexpr double kWorse = -1.5; // z below which the rival is none
constexpr double kBetter = 3;   // z from which the law of the catalogue is the worse one

// Nothing for a candidate without such a rival, or where the rival is worse.
std::optional<Outside> outside_rival(const Diagnosis& diagnosis, const Candidate& candidate,
                                     Assembler& assembler);

} // namespace servoid
