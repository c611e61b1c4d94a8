// A spring in the fit: what of it a constant torque beside it leaves to be known.
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

using namespace servoid;

namespace {

constexpr double kStiffness = 0.2, kRest = 0.7; // N·m/rad, rad
constexpr double kClose = 2e-5; // what the smoothing of the motion leaves in its pass band

FitResult fitted(const Model& model, const Capture& capture) {
    return fit(model, prepare_all({&capture, 1}, {40.0, {}}));
}

} // namespace

// Together they are one constant: what a spring rests at and what is there besides.
TEST(SpringFitted, StiffnessBesideAConstantTorque) {
    const Capture c =
        sampled([](const Kinematics& k,
                   double) { return rigid_torque(k) + kStiffness * (k.position - kRest); },
                6);
    for (const double start : {kStiffness, 1.0, 0.05}) {
        Model model = rigid_axis(1, 1, 1);
        model.effects.push_back(term("spring", {{"stiffness", start}, {"rest_position", kRest}}));
        const FitResult f = fitted(model, c);
        const EffectTerm &constant = f.model.effects[1], &spring = f.model.effects[2];
        EXPECT_NEAR(spring.at("stiffness"), kStiffness, 1e-4) << start;
        EXPECT_EQ(spring.at("rest_position"), kRest) << start;
        EXPECT_NEAR(constant.at("torque"), kOffset, 1e-4) << start;
        EXPECT_LT(f.torque_error, kClose) << start;
    }
}

TEST(SpringFitted, RestPositionWithoutAConstantTorque) {
    const Capture c = sampled(
        [](const Kinematics& k, double) {
            return kInertia * k.acceleration + kStiffness * (k.position - kRest);
        },
        6);
    Model model;
    model.inertia = 1;
    model.effects = {term("spring", {{"stiffness", 1}, {"rest_position", 0}})};
    const FitResult f = fitted(model, c);
    EXPECT_NEAR(f.model.effects[0].at("rest_position"), kRest, 1e-3);
    EXPECT_NEAR(f.model.effects[0].at("stiffness"), kStiffness, 1e-4);
}
