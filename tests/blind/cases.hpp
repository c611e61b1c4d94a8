// One case of the blind test: a drive, an experiment, what the user believes, and what is hidden.
#pragma once

#include "blind/plans.hpp"
#include "blind/strength.hpp"
#include "blind/systems.hpp"
#include "capture/capture.hpp"

#include <string>
#include <vector>

namespace blind {

struct Case {
    std::vector<std::string> effects; // asked for; empty: nothing is hidden
    int seed = 0, attempt = 0;
    System system;
    std::string experiment;  // in words, for listings
    double torque_noise = 0; // of rated, per sample
    World world, base;       // with everything in it; without what is hidden
    Record record;           // the truth behind the capture
    std::vector<servoid::EffectTerm> hidden;
    servoid::Model known;
    servoid::Capture capture;
    Strength strength; // of the weakest hidden effect
    bool has_coulomb = false, has_constant = false, has_viscous = false; // in the believed model
};

// The same case for the same effects and seed, always. Draws again until the experiment shows every
// effect: its residual at 3 to 30 times the noise, 1 to 40 % of the torque.
Case make_case(const std::vector<std::string>& effects, int seed);

// Pairs for the test of two hidden effects.
const std::vector<std::vector<std::string>>& pairs();

} // namespace blind
