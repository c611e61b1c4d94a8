// Effects that resemble each other: told apart where the move can, and not where it cannot.
#include "diagnose/diagnose.hpp"
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace servoid;

namespace {

constexpr const char* kNoisy =
    "trapezoid:stroke=4,velocity=20,acceleration=1500,cycles=3,torque_noise=2e-3";
constexpr const char* kWide =
    "multisine:from_Hz=5,to_Hz=200,step_Hz=5,amplitude=0.3,periods=3,torque_noise=1e-3";

constexpr const char* kDelay = "[effects.dead_time]\ndelay = 0.6e-3\n";
constexpr const char* kLag = "[effects.torque_lag]\ntime_constant = 0.6e-3\n";

Diagnosis diagnosed(const std::string& hidden, const std::string& move, unsigned long seed = 3) {
    const Recorded r(drive(hidden), move, seed);
    Diagnosis d = diagnose(drive(), r.motions, {{}, false});
    std::printf("figure: seed %lu: %s, %s %.3f, %s %.3f\n", seed, verdict_name(d.verdict),
                d.candidates[0].effect.c_str(), d.candidates[0].probability,
                d.candidates[1].effect.c_str(), d.candidates[1].probability);
    return d;
}

bool is_delay(const std::string& effect) { return effect == "dead_time" || effect == "torque_lag"; }

} // namespace

TEST(Rivals, AMultisineTellsALagFromADeadTime) {
    for (const auto& [hidden, name] : {std::pair{kDelay, "dead_time"}, {kLag, "torque_lag"}}) {
        const Diagnosis d = diagnosed(hidden, kWide);
        EXPECT_EQ(d.verdict, Verdict::missing) << d.advice;
        EXPECT_EQ(d.candidates[0].effect, name);
    }
}

// Little of a trapezoid lies at high frequencies: what noise leaves of one and the other differs by
// some per cent, and not block after block.
TEST(Rivals, ANoisyTrapezoidDoesNot) {
    for (const unsigned long seed : {2, 3, 4}) {
        const Diagnosis d = diagnosed(kDelay, kNoisy, seed);
        EXPECT_EQ(d.verdict, Verdict::ambiguous) << "seed " << seed;
        EXPECT_TRUE(is_delay(d.candidates[0].effect) && is_delay(d.candidates[1].effect));
        EXPECT_GT(d.candidates[1].probability, 0.1) << "seed " << seed;
    }
}

// The error is a share of the torque that arrives, and the limit lets little of it through.
TEST(Rivals, ALimitThatCutsMostOfTheTorqueIsNamed) {
    const Diagnosis d =
        diagnosed("[effects.torque_saturation]\nlimit = 0.08\n",
                  "multisine:from_Hz=5,to_Hz=50,step_Hz=5,amplitude=1,periods=4,torque_noise=1e-3");
    const Candidate& first = d.candidates[0];
    std::printf("figure: of the torque that was asked for arrives %.2f\n",
                first.fit.torque.norm() / d.before.torque.norm());
    EXPECT_EQ(d.verdict, Verdict::missing) << d.advice;
    EXPECT_EQ(first.effect, "torque_saturation");
    EXPECT_LT(first.fit.torque.norm(), 0.7 * d.before.torque.norm());
}

// Far below its antiresonance a load is one number, (1 − (fa/fr)²)/fa²: neither frequency is known,
// and all the same it is no gap.
TEST(Rivals, ALoadFarBelowItsAntiresonanceIsNamed) {
    const Recorded r(
        bare_drive("[effects.elastic_load]\nantiresonance_frequency = 400\n"
                   "resonance_frequency = 630\nantiresonance_damping = 0.05\n"
                   "resonance_damping = 0.05\n"),
        "multisine:from_Hz=2,to_Hz=60,step_Hz=2,amplitude=0.5,periods=4,torque_noise=2e-3");
    const Diagnosis d = diagnose(bare_drive(), r.motions);
    const Candidate& first = d.candidates[0];
    EXPECT_EQ(d.verdict, Verdict::missing) << d.advice;
    ASSERT_EQ(first.effect, "elastic_load");
    const EffectTerm& load = first.fit.model.effects.back();
    const double antiresonance = load.at("antiresonance_frequency");
    const double resonance = load.at("resonance_frequency");
    const double gives =
        (1 - std::pow(antiresonance / resonance, 2)) / (antiresonance * antiresonance);
    const double truth = (1 - std::pow(400.0 / 630, 2)) / (400.0 * 400);
    std::printf("figure: %.4g and %.4g Hz, gives way by %.3f of the truth; %s\n", antiresonance,
                resonance, gives / truth, first.note.c_str());
    EXPECT_NEAR(gives / truth, 1, 0.1);
}
