// The move on which rival models differ most against the noise.
//
// Two models that explain a capture equally may still need different torques on another move. What
// counts is what a rival cannot take up: the record that one of them predicts is fitted by the
// other with all its parameters, and searched for its effect anew, as `diagnose` will do with the
// data to come. Hunter and Reiner, Technometrics 7, 1965; the smallest over pairs counts.
#pragma once

#include "compare/motion.hpp"
#include "diagnose/move_limits.hpp"
#include "model/model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace servoid {

struct Diagnosis;

struct NextExperiment {
    std::string experiment; // text for parse_experiment
    std::string reason;     // which rivals differ, by how much, and where, in words
    double separation = 0;  // what the wrong rival leaves, rms, in units of the noise
};

// From here on a proposal is worth recording. A diagnosis counts up to 150 independent residuals:
// a rival that leaves a quarter of the noise more is then some 90 times less probable,
// (1 + 0.25²)^75. With less, noise decides.
constexpr double kWorthRecording = 0.25;

// rivals: fitted, best first; the first four count. One may be another with an effect added: then
// only what the simple one cannot take up of the rich one counts, and the move is the one that
// would show that effect. Without a [controller] the torque is taken along the reference. motions:
// what was recorded, from which the limits follow. noise: rms of what is left of the torque in the
// band, N·m or N.
//
// Nothing where fewer than two rivals are given, the captures hold no position, or no move of the
// menu can be made within the limits. A separation below kWorthRecording: within these limits no
// move tells them apart, and it is an upper bound. The same data get the same answer. Cost: 0.05 to
// 0.5 s for two rivals, up to 2 s for four whose effects are searched for.
std::optional<NextExperiment> next_experiment(const std::vector<Model>& rivals,
                                              const std::vector<PreparedMotion>& motions,
                                              double noise);
// The same with limits of the caller's own: a longer travel that is known to be free, for instance.
std::optional<NextExperiment> next_experiment(const std::vector<Model>& rivals,
                                              const std::vector<PreparedMotion>& motions,
                                              double noise, const MoveLimits& limits);

// For the rivals that an ambiguous diagnosis has left, "nothing more" among them where that is
// probable; nothing for any other verdict.
std::optional<NextExperiment> next_of(const Diagnosis& diagnosis,
                                      const std::vector<PreparedMotion>& motions);

} // namespace servoid
