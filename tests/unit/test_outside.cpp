// A smooth law that the catalogue has no name for is not called by the nearest name it has.
#include "diagnose/diagnose.hpp"
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace servoid;

namespace {

constexpr const char* kToOneSide =
    "trapezoid:stroke=2,velocity=8,acceleration=100,cycles=3,torque_noise=2e-3";
constexpr const char* kFast =
    "trapezoid:stroke=12,velocity=40,acceleration=1000,cycles=3,torque_noise=2e-3";

std::string cubic(const std::string& of, const std::string& k) {
    return "[effects.custom.x]\nlaw = \"k*" + of + "^3\"\n[effects.custom.x.parameters]\nk = " + k +
           "\n";
}

Diagnosis diagnosed(const std::string& hidden, const std::string& move, unsigned long seed) {
    const Recorded r(drive(hidden), move, seed);
    Diagnosis d = diagnose(drive(), r.motions);
    std::printf("figure: seed %lu: %s, %s leaves %.3g %% of %.3g %%, outside \"%s\"\n", seed,
                verdict_name(d.verdict), d.candidates[0].effect.c_str(),
                100 * d.candidates[0].validation_error_after, 100 * d.validation_error_before,
                d.outside.c_str());
    return d;
}

// What the catalogue has a name for is called by it, for both seeds.
void expect_named(const std::string& effect, const std::string& parameters,
                  const std::string& move) {
    for (const unsigned long seed : {1, 2}) {
        const Diagnosis d = diagnosed("[effects." + effect + "]\n" + parameters, move, seed);
        EXPECT_EQ(d.verdict, Verdict::missing) << d.advice;
        EXPECT_EQ(d.candidates[0].effect, effect);
        EXPECT_EQ(d.outside, "");
    }
}

} // namespace

TEST(Outside, ASpringThatStiffensIsNoStop) {
    for (const unsigned long seed : {1, 2}) {
        const Diagnosis d = diagnosed(cubic("theta", "2e-3"), kToOneSide, seed);
        EXPECT_EQ(d.candidates[0].effect, "hard_stop");
        EXPECT_TRUE(d.verdict == Verdict::ambiguous || d.verdict == Verdict::unknown);
        EXPECT_NE(d.outside.find("theta"), std::string::npos);
        EXPECT_NE(d.advice.find("smooth law"), std::string::npos) << d.advice;
    }
}

TEST(Outside, AStopIsNoSmoothLaw) {
    expect_named("hard_stop", "position = 1.5\nstiffness = 0.05\n", kToOneSide);
}

TEST(Outside, ACubicDragIsNoSquareOne) {
    for (const unsigned long seed : {1, 2}) {
        const Diagnosis d = diagnosed(cubic("v", "2e-7"), kFast, seed);
        EXPECT_EQ(d.candidates[0].effect, "quadratic_drag");
        EXPECT_NE(d.verdict, Verdict::missing) << d.advice;
        EXPECT_NE(d.outside.find("v/"), std::string::npos);
    }
}

TEST(Outside, ASquareDragIsNoCubicOne) {
    expect_named("quadratic_drag", "coefficient = 3e-5\n", kFast);
}
