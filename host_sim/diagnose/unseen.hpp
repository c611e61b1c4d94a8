// What a capture cannot show, and what to record to see it.
#pragma once

#include "diagnose/candidates.hpp"

#include <optional>
#include <string>
#include <vector>

namespace servoid {

struct Diagnosis;

struct Unseen {
    std::string effect;
    std::string why;
    std::string record; // instead
};

// Effects outside the model that neither can be found nor excluded: refused ones, those that this
// kind of motion gives another name, and amplitudes that may be large and are not determined.
std::vector<Unseen> unseen_of(const Diagnosis& diagnosis, Assembler& assembler);

// On one-way motion Coulomb friction and a constant torque are the same: both names get the same
// probability and a note. Where the model has one of them, the other is no finding.
void share_aliases(Diagnosis& diagnosis, const std::vector<PreparedMotion>& motions);

// Why the capture cannot answer at all: hardly any motion, one constant speed, or nothing that
// could be judged. Only where no effect stands out.
std::optional<Unseen> shortage_of(const Diagnosis& diagnosis, Assembler& assembler);

} // namespace servoid
