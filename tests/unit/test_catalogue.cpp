// Every effect that the torque view fits: put into the simulated axis with random values, it is
// found again with those values.
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "effects/catalogue.hpp"
#include "plant/simulate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace servoid;

namespace {

Model motor() {
    return parse_model(R"(name = "motor"
motion = "rotary"
[plant]
inertia = 1e-5
[controller]
type = "p_pi"
position_gain = 40.0
speed_gain = 2.9e-3
integral_time = 0.016
sample_time = 125e-6
[sensor]
counts_per_rev = 4194304
)",
                       "motor");
}

// Friction of a motor of this size; what a trapezoid move shows well.
double random_value(Quantity quantity, std::mt19937_64& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    switch (quantity) {
    case Quantity::viscous:
        return between(0.5e-4, 3e-4);
    case Quantity::torque:
        return between(4e-3, 1.2e-2);
    default:
        return between(0.5, 1.5);
    }
}

// What the first milestone's torque view fits.
const std::set<std::string> fitted = {"viscous", "viscous_asymmetric", "coulomb",
                                      "coulomb_asymmetric", "constant_torque"};

EffectTerm random_term(const EffectInfo& info, std::mt19937_64& random) {
    EffectTerm term;
    term.name = info.name;
    for (const ParameterInfo& p : info.parameters)
        term.parameters[p.key] = random_value(p.quantity, random);
    return term;
}

// Accelerates with three times the largest friction, so that the axis slides through each reversal.
Capture trapezoid(const Model& model) {
    return simulate(
        model, parse_experiment("trapezoid:stroke=6.28,velocity=60,acceleration=4000,cycles=6"), 1);
}

Model forgotten(Model model) {
    model.inertia *= 1.3;
    for (EffectTerm& term : model.effects)
        for (auto& [key, value] : term.parameters)
            value = 0;
    return model;
}

void expect_found(const Model& truth, const Model& found, unsigned long seed) {
    EXPECT_NEAR(found.inertia / truth.inertia, 1, 0.01) << "seed " << seed;
    for (size_t i = 0; i < truth.effects.size(); ++i)
        for (const auto& [key, value] : truth.effects[i].parameters)
            EXPECT_NEAR(found.effects[i].at(key) / value, 1, 0.01)
                << truth.effects[i].name << "." << key << " = " << value << ", seed " << seed;
}

class EveryFittedEffect : public testing::TestWithParam<std::string> {};

TEST_P(EveryFittedEffect, IsRecoveredFromASimulatedMove) {
    const Effect* effect = find_effect(GetParam());
    ASSERT_TRUE(effect);
    for (unsigned long seed = 1; seed <= 8; ++seed) {
        std::mt19937_64 random(seed);
        Model truth = motor();
        truth.effects.push_back(random_term(effect->info(), random));
        const Capture capture = trapezoid(truth);
        const FitResult f = fit(forgotten(truth), prepare_all({&capture, 1}, {}));
        expect_found(truth, f.model, seed);
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryFittedEffect, testing::ValuesIn(fitted),
                         [](const testing::TestParamInfo<std::string>& test) {
                             return test.param;
                         });

TEST(Catalogue, SeveralEffectsTogether) {
    for (unsigned long seed = 1; seed <= 8; ++seed) {
        std::mt19937_64 random(seed);
        Model truth = motor();
        for (const char* name : {"viscous", "coulomb", "constant_torque"})
            truth.effects.push_back(random_term(find_effect(name)->info(), random));
        const Capture capture = trapezoid(truth);
        const FitResult f = fit(forgotten(truth), prepare_all({&capture, 1}, {}));
        expect_found(truth, f.model, seed);
    }
}

TEST(Catalogue, EveryEffectSaysWhatItIs) {
    std::set<std::string> names;
    for (const Effect* effect : catalogue()) {
        const EffectInfo& info = effect->info();
        SCOPED_TRACE(info.name);
        EXPECT_TRUE(names.insert(info.name).second);
        EXPECT_EQ(find_effect(info.name), effect);
        EXPECT_FALSE(info.law.empty());
        EXPECT_FALSE(info.signature.empty());
        EXPECT_FALSE(info.reference.empty());
        if (info.written) {
            EXPECT_FALSE(info.example.empty());
            continue;
        }
        std::mt19937_64 random(1);
        EXPECT_LE(effect->linear_count(random_term(info, random)), int(info.parameters.size()));
        for (const ParameterInfo& p : info.parameters) {
            EXPECT_FALSE(p.meaning.empty()) << p.key;
            EXPECT_LT(p.lower, p.upper) << p.key;
            for (const Motion motion : {Motion::rotary, Motion::linear})
                EXPECT_NO_THROW(unit_of(p.quantity, motion)) << p.key;
        }
    }
    for (const std::string& name : fitted)
        EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Catalogue, WhatCannotStandTogether) {
    Model model = motor();
    EXPECT_EQ(cannot_add(*find_effect("coulomb"), model), "");
    std::mt19937_64 random(1);
    model.effects.push_back(random_term(find_effect("coulomb_asymmetric")->info(), random));
    EXPECT_NE(cannot_add(*find_effect("coulomb"), model), "");
    EXPECT_NE(cannot_add(*find_effect("coulomb_asymmetric"), model), "");
    EXPECT_EQ(cannot_add(*find_effect("viscous"), model), "");
    EXPECT_EQ(find_effect("witchcraft"), nullptr);
}

} // namespace

// Only a model made in memory can hold a period on a rotary axis; there is no order to judge.
TEST(Order, IsNotAskedOfATermThatHoldsAPeriod) {
    const Estimates estimates = {{"amplitude", {1, 0.1}}, {"period", {0.5, 0.01}}};
    for (const char* name : {"cogging", "torque_ripple"})
        EXPECT_EQ(find_effect(name)->evidence(estimates, MotionView{}), 0) << name;
}
