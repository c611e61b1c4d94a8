// What diagnose and refine said of a case, against the truth.
#pragma once

#include "blind/cases.hpp"
#include "diagnose/diagnose.hpp"

#include <string>
#include <vector>

namespace blind {

struct ParameterCheck {
    std::string name;
    double truth = 0, value = 0, std = 0;
    bool good = false; // within 5 % or 3 stated standard deviations
};

struct Verdict {
    std::string truth;          // hidden effects, joined; "nothing"
    std::string verdict, first; // as the tool says
    std::string named;          // column of the confusion matrix
    double probability = 0;     // of the first candidate
    bool first_right = false;   // truth, or its equal, is the first candidate and was put forward
    double error_before = 0, error_after = 0, floor = 0;
    double true_floor = 0; // noise of the world in the tool's band
    double complete_error =
        0; // of the believed model with the hidden effects, fitted; 0: not known
    double band_Hz = 0;
    std::vector<ParameterCheck> parameters; // where the first candidate is right
    double seconds = 0;
    std::string failure; // what was thrown
    servoid::Diagnosis diagnosis;
    // Of refine:
    std::vector<std::string> ladder;
    bool all_found = false;
};

// Names that are right for a hidden effect, the truth first. Equals:
//   coulomb_asymmetric = coulomb + constant_torque: what of the two is missing is the simpler name;
//   viscous_asymmetric where symmetric viscous friction is missing too: viscous is the larger part;
//   presliding that bends over less than the band and the encoder can show = coulomb;
//   gravity = cogging of order 1, and the simpler name wins, so this one is not accepted.
std::vector<std::string> right_names(const Case& c);

Verdict judge(const Case& c);        // diagnose
Verdict judge_refine(const Case& c); // refine: are all hidden effects in its model

// Nothing hidden: adequate; outside the catalogue: unknown or ambiguous; else the truth first.
bool as_it_should(const Case& c, const Verdict& v);

std::string describe(const Case& c, const Verdict& v, bool verbose);

} // namespace blind
