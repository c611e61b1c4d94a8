// A simulated drive whose truth is known, and what is recorded of it.
#pragma once

#include "compare/compare.hpp"
#include "plant/simulate.hpp"

#include <string>
#include <vector>

namespace servoid {

// System 2 of the paper without its elastic load; `effects` in TOML.
inline Model bare_drive(const std::string& effects = "") {
    return parse_model(
        "motion = \"rotary\"\n[plant]\ninertia = 5.56e-5\n[controller]\ntype = \"p_pi\"\n"
        "position_gain = 40.0\nspeed_gain = 7e-3\nintegral_time = 0.016\nsample_time = 125e-6\n"
        "[sensor]\ncounts_per_rev = 131072\n[drive]\nrated_torque = 0.637\n" +
            effects,
        "drive");
}

// With its friction.
inline Model drive(const std::string& more = "") {
    return bare_drive("[effects.viscous]\ncoefficient = 9.6e-4\n[effects.coulomb]\n"
                      "torque = 2.1e-2\n" +
                      more);
}

// What a move of the truth gives, with the motions that point into it.
struct Recorded {
    Recorded(const Model& truth, const std::string& move, unsigned long seed = 3)
        : captures{simulate(truth, parse_experiment(move), seed)},
          motions(prepare_all(captures, {})) {}
    Recorded(const Recorded&) = delete;
    Recorded& operator=(const Recorded&) = delete;
    std::vector<Capture> captures;
    std::vector<PreparedMotion> motions;
};

} // namespace servoid
