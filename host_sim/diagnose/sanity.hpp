// Whether a capture can be what it says it is: the sign of the torque, its time, the units, the
// gain.
//
// What is wrong in the recording is said, not fitted: a model takes up a reversed torque, a shifted
// column or a wrong unit somehow, and the effects that it then seems to lack have no meaning.
#pragma once

#include "compare/regression.hpp"

#include <string>
#include <vector>

namespace servoid {

struct Suspicion {
    enum class Kind { reversed, shifted, unit, gain };
    Kind kind = Kind::gain;
    std::string sentence; // what the numbers say, and the likely cause
    std::string remedy;   // what to change or to record
    bool refuses = false; // else it is a warning: the fit means something
    double amount = 0;    // s of delay, or the factor
};

// From torque and motion alone; the model only says which laws are to be expected.
// reversed: the torque the other way round leaves much less, with inertia and friction positive.
// shifted: a torque that comes after the motion it causes, by more than a sample; or before it by
// more than a loop could survive. A small delay is physics (`dead_time`) and no suspicion.
std::vector<Suspicion> capture_suspicions(const Model& believed, Assembler& assembler);

// From what is believed. unit: the fitted values are off by a factor that a unit explains, all of
// them as that unit says; one value alone only by 30 times or more. gain: inertia, friction and all
// else off by one common factor, by 20 % or more, in a fit that explains the
// torque. Only numbers count that explain more of the torque than is left open.
std::vector<Suspicion> belief_suspicions(const Model& believed, const FitResult& before,
                                         Assembler& assembler);

// All of them, refusing ones first. What cannot be fitted at all has no belief_suspicions.
std::vector<Suspicion> suspicions(const Model& believed,
                                  const std::vector<PreparedMotion>& motions);

// Throws Refusal for the first that refuses; the sentences of the others.
std::vector<std::string> warnings_or_refusal(const std::vector<Suspicion>& found);

} // namespace servoid
