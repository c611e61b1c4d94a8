// What this method itself leaves of a model that is complete, and what it makes of noise.
//
// Each law is evaluated along a measured motion: at a reversal where the axis sticks for a moment,
// along a quantised position, behind a gap, that is an approximation. And noise goes round the loop
// until it looks like dynamics. Both can be known beforehand where the loop is: the model drives
// itself along the recorded reference, and its capture goes through the same filters and fits
// (parametric bootstrap, Efron and Tibshirani 1993; of a likelihood ratio, Cox 1962).
#pragma once

#include "compare/regression.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace servoid {

// Captures of one model, prepared like the measured ones.
struct TwinSet {
    std::vector<std::unique_ptr<Capture>> captures;
    std::vector<PreparedMotion> motions;
};

// A model and where the captures' position zeros lie.
struct HomedModel {
    const Model& model;
    const Homing& homing;
    Model at(size_t capture) const { return at_zero(model, homing.of(capture)); }
};

// noise: standard deviation of the torque noise in band, N·m or N. Nothing where a capture cannot
// be simulated (loop_twin.hpp), or where the simulated axis moves unlike the measured one.
// Each at its capture's position zero.
std::optional<TwinSet> make_twins(const HomedModel& model,
                                  const std::vector<PreparedMotion>& motions, double noise,
                                  unsigned long seed);

// The fit again, with what the method leaves of the fitted model taken out of the torque, as far as
// the residual shows it. The fit as it was where there are no twins or they do not help.
// rounds: the artifact is that of the model, which moves with it.
FitResult without_artifact(const FitResult& fitted, Assembler& assembler, int rounds);

// By how much the logarithm of the held-out error falls when `effect` is added to twins of
// `fitted`, in which nothing is missing and all of its residual is torque noise: the largest of a
// few. Nothing where there are no twins.
std::optional<double> gain_from_noise(const FitResult& fitted, const Effect& effect,
                                      Assembler& assembler);

} // namespace servoid
