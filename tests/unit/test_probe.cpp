// What a residual depends on: the variable of a hidden law, and not a factor that the law has
// without it.
#include "compare/compare.hpp"
#include "diagnose/probe.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>

using namespace servoid;

namespace {

constexpr double kCoulomb = 0.1, kNoise = 0.05; // N·m
constexpr unsigned kSeed = 20261122;

double sign(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

// Share of the residual's power that a free function of each variable explains.
std::map<std::string, double> explained(const Model& model, const TorqueLaw& law) {
    std::mt19937 random(kSeed);
    std::normal_distribution<double> noise(0, kNoise);
    const std::vector<Capture> captures = {
        sampled([&](const Kinematics& k, double t) { return law(k, t) + noise(random); }, 20)};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {40.0, {}});
    Assembler assembler(motions);
    std::map<std::string, double> out;
    for (const Probe& p : probe_residual(fit(model, assembler), assembler)) {
        std::printf("figure: %s explains %.3f\n", p.name.c_str(), p.explained);
        out[p.name] = p.explained;
    }
    return out;
}

Model believed() { return rigid_axis(kInertia, kViscous, kOffset); }

} // namespace

TEST(Probe, CoulombFrictionDependsOnTheVelocityOnly) {
    const auto share = explained(believed(), [](const Kinematics& k, double) {
        return rigid_torque(k) + kCoulomb * sign(k.velocity);
    });
    EXPECT_GT(share.at("velocity"), 0.8);
    for (const char* name : {"direction × time", "direction × position"})
        EXPECT_LT(share.at(name), 0.2) << name;
}

TEST(Probe, FrictionThatDriftsDependsOnTime) {
    const auto share = explained(believed(), [](const Kinematics& k, double t) {
        return rigid_torque(k) + kCoulomb * (t / 10 - 1) * sign(k.velocity);
    });
    EXPECT_GT(share.at("direction × time"), 0.8);
    for (const char* name : {"velocity", "direction × position"})
        EXPECT_LT(share.at(name), 0.2) << name;
}

// An inertia that is believed too small leaves an acceleration, and nothing that changes it.
TEST(Probe, AWrongInertiaDoesNotChangeAndAVariableOneDoes) {
    Model half = believed();
    half.inertia /= 2, half.inertia_fixed = true;
    const auto constant =
        explained(half, [](const Kinematics& k, double) { return rigid_torque(k); });
    for (const char* name : {"acceleration × position", "acceleration × time"})
        EXPECT_LT(constant.at(name), 0.2) << name;
    const auto variable = explained(half, [](const Kinematics& k, double) {
        return rigid_torque(k) + 0.3 * kInertia * std::cos(2 * k.position) * k.acceleration;
    });
    EXPECT_GT(variable.at("acceleration × position"), 0.8);
    EXPECT_LT(variable.at("acceleration × time"), 0.2);
}
