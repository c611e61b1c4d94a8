// All effects there are, in the order in which the documentation lists them.
#pragma once

#include "effects/effect.hpp"

namespace servoid {

const std::vector<const Effect*>& catalogue();

// nullptr where there is no such effect. custom.<name> is `custom`, whatever the name.
const Effect* find_effect(const std::string& name);

// Why this effect cannot stand in this model ("needs coulomb", "replaces viscous", "rotary axes
// only"), or an empty string.
std::string cannot_add(const Effect& effect, const Model& model);

// The first parameter of a model's terms that lies outside its bounds, in words, or "": a
// coefficient that is solved for knows no upper bound.
std::string out_of_bounds(const Model& model);

} // namespace servoid
