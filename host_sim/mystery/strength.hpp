// How strongly a hidden effect shows in one experiment.
#pragma once

#include "compare/motion.hpp"
#include "effects/hiding.hpp"
#include "mystery/mystery.hpp"
#include "plant/simulate.hpp"

#include <optional>

namespace servoid {

struct Strength {
    double share = 0;   // that the effect leaves of the torque, beyond what was left without it
    double floor = 0;   // left without it
    double unnamed = 0; // left of `share` where the effect is in the model: what no fit would find
    double band_Hz = 0;
};

// A drive, an experiment, one noise: the move without a hidden effect is simulated once.
class Stage {
  public:
    Stage(const Model& model, const Experiment& experiment, unsigned long noise_seed);
    Stage(const Stage&) = delete; // its motions point at its capture
    Stage& operator=(const Stage&) = delete;

    const Scenery& scenery() const { return scenery_; }
    // Nothing where the axis does not survive the effect: it stands still, runs away, leaves its
    // travel, saturates, swings.
    std::optional<Strength> strength(const EffectTerm& hidden) const;
    // Why the effect could not be told: its own word on this motion, or the refusal of a fit that
    // does not know it; or "".
    std::string cannot_show(const EffectTerm& hidden) const;

  private:
    // The model and those of viscous, Coulomb and constant torque that it lacks and that this
    // motion can tell apart; `but` stays out.
    Model refitted(const std::string& but) const;
    std::string refusal(const EffectTerm& hidden) const;
    bool healthy(const SimulatedRun& run, const EffectTerm& hidden) const;

    const Model& model_;
    const Experiment& experiment_;
    unsigned long noise_seed_;
    SimulatedRun without_;
    std::vector<PreparedMotion> motions_; // of `without_`
    Scenery scenery_;
};

} // namespace servoid
