// One effect hidden in a simulated drive, for someone to find.
//
// The seed chooses the effect and its parameters; the strength follows from the experiment: what a
// model without the effect leaves of the torque, with inertia, viscous friction, Coulomb friction
// and constant torque fitted again, is kLeastShare to kMostShare of it. An effect that the
// experiment cannot show, or that would spoil the move, gives way to the next one.
#pragma once

#include "effects/effect.hpp"
#include "plant/experiment.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace servoid {

constexpr double kLeastShare = 0.05, kMostShare = 0.30; // of the torque's rms

struct Mystery {
    std::uint64_t seed = 0;
    EffectTerm hidden;
    Motion motion = Motion::rotary;
    double share = 0;   // of the torque's rms, in the band of the torque view
    double band_Hz = 0; // chosen from the data, as `compare` does
};

// The model with an effect of the catalogue in it; what the effect stands for is taken out.
Model with_hidden(Model model, const EffectTerm& hidden);

// The share says what the capture with this noise shows; the effect and its parameters depend on
// the model, the experiment and the mystery's seed alone. Throws Refusal where the experiment shows
// no effect that the model lacks, UsageError as simulate() does.
Mystery make_mystery(const Model& model, const Experiment& experiment, std::uint64_t seed,
                     unsigned long noise_seed);

} // namespace servoid
