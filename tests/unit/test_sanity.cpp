// Captures that are wrong are recognised and named; good ones, with whatever the model lacks, are
// not.
#include "common/error.hpp"
#include "compare/compare.hpp"
#include "diagnose/sanity.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace servoid;

namespace {

using Kind = Suspicion::Kind;

constexpr const char* kMove = "trapezoid:stroke=6.28,velocity=40,cycles=4,torque_noise=1e-3";
constexpr const char* kRich = "multisine:from_Hz=5,to_Hz=250,step_Hz=5,amplitude=0.1";

EffectTerm term(const std::string& name, const std::map<std::string, double>& parameters) {
    EffectTerm out;
    out.name = name, out.parameters = parameters;
    return out;
}

Model motor() { return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system1.toml"); }

Capture recorded(const Model& truth, const char* move = kMove) {
    return simulate(truth, parse_experiment(move), 3);
}

// `by` rows later in the file; the rows that are missing then are the nearest there is.
Capture with_torque_later(const Capture& c, long by) {
    Capture out = c;
    for (long i = 0; i < long(c.rows()); ++i)
        out.torque_ref[size_t(i)] =
            c.torque_ref[size_t(std::clamp(i - by, 0L, long(c.rows()) - 1))];
    return out;
}

Capture scaled(Capture c, double torque, double position = 1) {
    for (double& x : c.torque_ref)
        x *= torque;
    for (std::vector<double>* column : {&c.position, &c.position_ref})
        for (double& x : *column)
            x *= position;
    c.position_quantum *= position, c.torque_quantum *= std::abs(torque);
    return c;
}

std::vector<Suspicion> said_of(const Model& model, const Capture& capture) {
    const std::vector<Capture> captures = {capture};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {});
    std::vector<Suspicion> out = suspicions(model, motions);
    for (const Suspicion& s : out)
        fmt::print("figure: {}: {}\n", s.refuses ? "refused" : "warned", s.sentence);
    return out;
}

// The first suspicion, which is to be this one.
Suspicion expect_named(const std::vector<Suspicion>& found, Kind kind, bool refuses,
                       const std::string& words) {
    if (found.empty()) {
        ADD_FAILURE() << "nothing was said of: " << words;
        return {};
    }
    EXPECT_EQ(found[0].kind, kind) << found[0].sentence;
    EXPECT_EQ(found[0].refuses, refuses) << found[0].sentence;
    EXPECT_NE(found[0].sentence.find(words), std::string::npos) << found[0].sentence;
    EXPECT_FALSE(found[0].remedy.empty());
    return found[0];
}

void expect_nothing(const Model& model, const Capture& capture, const std::string& what) {
    for (const Suspicion& s : said_of(model, capture))
        ADD_FAILURE() << what << ": " << s.sentence;
}

Model with_all_times(Model model, double factor) {
    model.inertia *= factor;
    for (EffectTerm& e : model.effects)
        for (auto& [key, value] : e.parameters)
            value *= factor;
    return model;
}

} // namespace

TEST(Sanity, AGoodCaptureIsNoSuspect) {
    for (const char* move : {kMove, kRich, "sine:frequency_Hz=10,amplitude=1,periods=20"})
        expect_nothing(motor(), recorded(motor(), move), move);
}

TEST(Sanity, ReversedTorque) {
    for (const char* move : {kMove, kRich})
        expect_named(said_of(motor(), scaled(recorded(motor(), move), -1)), Kind::reversed, true,
                     "torque looks reversed");
}

TEST(Sanity, ReversedTorqueOfAModelThatLacksMuch) {
    Model truth = motor();
    truth.effects.push_back(term("gravity", {{"torque", 0.02}, {"phase", 0.4}}));
    Model bare = motor();
    bare.effects.clear();
    expect_named(said_of(bare, scaled(recorded(truth), -1)), Kind::reversed, true, "reversed");
}

TEST(Sanity, UnitsOfTorque) {
    const Capture good = recorded(motor());
    const Suspicion milli = expect_named(said_of(motor(), scaled(good, 1000)), Kind::unit, true,
                                         "torque in mN·m, read as N·m");
    EXPECT_NE(milli.sentence.find("everything comes out"), std::string::npos);
    EXPECT_NE(milli.sentence.find("too large"), std::string::npos);
    const Suspicion inverse = expect_named(said_of(motor(), scaled(good, 1e-3)), Kind::unit, true,
                                           "N·m, read as torque in mN·m");
    EXPECT_NE(inverse.sentence.find("too small"), std::string::npos);
}

// Inertia and viscous friction move with the unit of the position, Coulomb friction does not.
TEST(Sanity, UnitsOfPosition) {
    const Capture good = recorded(motor());
    const double degree = 180 / std::numbers::pi;
    const Suspicion degrees = expect_named(said_of(motor(), scaled(good, 1, degree)), Kind::unit,
                                           true, "position in degrees, read as rad");
    EXPECT_EQ(degrees.sentence.find("mN"), std::string::npos) << degrees.sentence;
    expect_named(said_of(motor(), scaled(good, 1, 1 / (2 * std::numbers::pi))), Kind::unit, true,
                 "position in revolutions, read as rad");
}

TEST(Sanity, TorqueAfterTheMotionItCauses) {
    const Capture good = recorded(motor(), kRich);
    for (const long rows : {3L, 200L}) {
        const Suspicion late = expect_named(said_of(motor(), with_torque_later(good, rows)),
                                            Kind::shifted, true, "after the motion it causes");
        EXPECT_NEAR(late.amount, -double(rows) * good.sample_time_s, good.sample_time_s);
    }
}

// What a real drive does too: it stays a candidate.
TEST(Sanity, ASmallDelayIsPhysics) {
    expect_nothing(motor(), with_torque_later(recorded(motor(), kRich), -3), "three samples early");
    Model truth = motor();
    truth.effects.push_back(term("dead_time", {{"delay", 1e-3}}));
    expect_nothing(motor(), recorded(truth, kRich), "a millisecond of dead time");
}

TEST(Sanity, ADelayThatNoLoopSurvives) {
    for (const char* move : {kMove, kRich}) {
        const Suspicion early =
            expect_named(said_of(motor(), with_torque_later(recorded(motor(), move), -200)),
                         Kind::shifted, true, "more than a loop survives");
        EXPECT_NEAR(early.amount, 25e-3, 5e-4);
    }
}

// A measured current may be filtered: said, not refused.
TEST(Sanity, ALittleLateIsAWarningOfAMeasuredTorque) {
    Capture c = with_torque_later(recorded(motor(), kRich), 6);
    c.torque = c.torque_ref;
    c.torque_ref.clear();
    expect_named(said_of(motor(), c), Kind::shifted, false, "filtered");
}

TEST(Sanity, OneGainOnEverything) {
    const auto found = said_of(motor(), scaled(recorded(motor()), 1.3));
    EXPECT_NEAR(expect_named(found, Kind::gain, false, "times what is believed").amount, 1.3, 0.02);
    EXPECT_NO_THROW(EXPECT_EQ(warnings_or_refusal(found).size(), 1u));
}

TEST(Sanity, AWrongInertiaIsNeitherGainNorUnit) {
    const Capture good = recorded(motor());
    for (const double factor : {0.1, 1 / 3.0, 0.7, 1.4, 3.0, 10.0}) {
        Model believed = motor();
        believed.inertia *= factor;
        expect_nothing(believed, good, fmt::format("inertia times {}", factor));
    }
}

TEST(Sanity, BeliefsTenPerCentOff) {
    const Capture good = recorded(motor());
    for (const double factor : {0.9, 1.1})
        expect_nothing(with_all_times(motor(), factor), good, fmt::format("all times {}", factor));
}

TEST(Sanity, WhatTheModelLacksIsNoSuspect) {
    const std::vector<EffectTerm> missing = {
        term("gravity", {{"torque", 0.03}, {"phase", 0.4}}),
        term("spring", {{"stiffness", 5e-3}, {"rest_position", 1}}),
        term("cogging", {{"amplitude", 5e-3}, {"order", 4}, {"phase", 1}}),
        term("quadratic_drag", {{"coefficient", 8e-6}}),
        term("presliding", {{"stiffness", 0.3}, {"torque", 0.02}}),
        term("torque_lag", {{"time_constant", 1e-3}}),
        term("variable_inertia", {{"fraction", 0.3}, {"order", 1}, {"phase", 0}})};
    for (const EffectTerm& effect : missing) {
        Model truth = motor();
        truth.effects.push_back(effect);
        expect_nothing(motor(), recorded(truth), effect.name);
    }
    Model bare = motor();
    bare.effects.clear();
    expect_nothing(bare, recorded(motor()), "friction");
}

// A spring that is stronger than the inertia turns the inertia's sign on a slow sine. The axis
// takes up work all the same: the torque is not reversed.
TEST(Sanity, AStrongSpringIsNotAReversedTorque) {
    Model truth = motor();
    truth.effects.push_back(term("spring", {{"stiffness", 0.1}, {"rest_position", 0}}));
    const Capture c = recorded(truth, "sine:frequency_Hz=3,amplitude=1,periods=8");
    expect_nothing(motor(), c, "spring");
    const std::vector<Capture> captures = {c};
    EXPECT_NO_THROW(fit(motor(), prepare_all(captures, {})));
}

TEST(Sanity, TheFirstThatRefusesIsTheRefusal) {
    Suspicion warns{Kind::gain, "a gain", "look", false, 1.3};
    Suspicion refuses{Kind::unit, "a unit", "the right one", true, 1000};
    EXPECT_EQ(warnings_or_refusal({warns}).front(), "a gain; look");
    try {
        warnings_or_refusal({warns, refuses});
        FAIL() << "was not refused";
    } catch (const Refusal& refusal) {
        EXPECT_EQ(refusal.reason(), "a unit");
        EXPECT_EQ(refusal.record_instead(), "the right one");
    }
}
