// How much later the torque acts than the model believes.
#pragma once

#include "compare/motion.hpp"
#include "model/model.hpp"

#include <optional>
#include <vector>

namespace servoid {

// The delay τ, s, at which the recorded torque T(t − τ) fits best what the model's laws need for
// the measured motion, both through the same band limit; what the model says itself of dead time,
// lag and half a sample of hold is in T already. Positive: the torque was recorded earlier than it
// acts (dead time, a lag, a filter). Negative: it was recorded later (a filtered measurement).
//
// The coefficients of the model's laws are free, and viscous and Coulomb friction and a constant
// torque are there beside them: a missing friction turns the phase as well, but not in proportion
// to the frequency. The standard deviation is of the correlated residual.
//
// Nothing where the motion does not tell a delay from those (a single sine: viscous friction), or
// where the best delay lies at the end of the search, 50 ms, four periods of the band edge or less.
std::optional<Estimate> lag_of_torque(const Model& model,
                                      const std::vector<PreparedMotion>& motions);

} // namespace servoid
