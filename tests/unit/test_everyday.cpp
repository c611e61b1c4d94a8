// What every axis has is found first where a model has none of it.
#include "diagnose/diagnose.hpp"
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace servoid;

namespace {

std::string first_without_friction(const Model& truth, const std::string& move) {
    const Recorded r(truth, move);
    const Diagnosis d = diagnose(bare_drive(), r.motions, {{}, false});
    std::printf("figure: %s: %s, %s %.3f, %s %.3f\n", move.c_str(), verdict_name(d.verdict),
                d.candidates[0].effect.c_str(), d.candidates[0].probability,
                d.candidates[1].effect.c_str(), d.candidates[1].probability);
    EXPECT_TRUE(d.everyday);
    if (d.everyday) {
        EXPECT_LT(d.everyday->error, 0.2 * d.candidates[0].validation_error_after);
    }
    return d.candidates[0].effect;
}

} // namespace

// Both frictions together turn the phase as a bristle does that bends far.
TEST(Everyday, FrictionIsNoBristle) {
    for (const auto& [coulomb, move] :
         {std::pair{"3e-2", "sine:frequency_Hz=3,amplitude=1,periods=6,torque_noise=1e-3"},
          {"6e-2", "sine:frequency_Hz=5,amplitude=0.5,periods=6,torque_noise=1e-3"}}) {
        const Model truth = bare_drive("[effects.viscous]\ncoefficient = 2e-3\n"
                                       "[effects.coulomb]\ntorque = " +
                                       std::string(coulomb) + "\n");
        const std::string first = first_without_friction(truth, move);
        EXPECT_TRUE(first == "coulomb" || first == "viscous") << first;
    }
}

// And as an elastic load does near its resonance.
TEST(Everyday, FrictionIsNoElasticLoad) {
    for (const char* move : {"sine:frequency_Hz=7,amplitude=1,periods=6,torque_noise=1e-3",
                             "sine:frequency_Hz=10,amplitude=0.5,periods=6,torque_noise=1e-3"}) {
        const std::string first = first_without_friction(drive(), move);
        EXPECT_TRUE(first == "coulomb" || first == "viscous") << first;
    }
}
