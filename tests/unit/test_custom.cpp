// custom laws in a model: simulated, found again in a capture, refused with a reason.
#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/diagnose.hpp"
#include "effects/catalogue.hpp"
#include "effects/custom_argument.hpp"
#include "plant/axis_engine.hpp"
#include "plant/simulate.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace servoid;

namespace {

EffectTerm custom(const std::string& law, const std::map<std::string, double>& parameters = {},
                  const std::vector<std::string>& fixed = {}) {
    return {"custom.x", parameters, fixed, law};
}

Model motor(const std::vector<EffectTerm>& effects = {}) {
    Model model = parse_model(R"(motion = "rotary"
[plant]
inertia = 1.16e-5
[controller]
type = "p_pi"
position_gain = 40.0
speed_gain = 2.9154e-3
integral_time = 0.0159155
sample_time = 125e-6
[sensor]
counts_per_rev = 1048576
[effects.viscous]
coefficient = 0.75e-4
)",
                              "motor");
    model.effects.insert(model.effects.end(), effects.begin(), effects.end());
    return model;
}

Capture move(const Model& model, double noise = 0) {
    return simulate(model,
                    parse_experiment("trapezoid:stroke=6.28,velocity=50,cycles=4,torque_noise=" +
                                     std::to_string(noise)),
                    1);
}

struct Fitted {
    FitResult fit;
    double floor;
    const FittedParameter& operator[](const std::string& name) const {
        for (const FittedParameter& p : fit.parameters)
            if (p.name == name) return p;
        throw std::out_of_range(name);
    }
};

Fitted fitted(const Model& model, const Capture& capture) {
    const std::vector<PreparedMotion> motions = prepare_all({&capture, 1}, {});
    const FitResult f = fit(model, motions);
    return {f, noise_floor_of_all(f.model, motions).ratio};
}

std::string refusal(const Model& model, const Capture& capture) {
    try {
        fitted(model, capture);
        return "";
    } catch (const Refusal& refused) {
        return refused.what();
    }
}

void expect_within_3_std(const FittedParameter& p, double truth) {
    EXPECT_GT(p.estimate.std, 0) << p.name;
    EXPECT_NEAR(p.estimate.value, truth, 3 * p.estimate.std) << p.name;
}

// Both through the general engine: the exact one has no opposing laws.
std::unique_ptr<Axis::Engine> engine_of(const EffectTerm& term) {
    AxisDescription axis;
    axis.inertia = 1e-5;
    find_effect(term.name)->add_to(axis, term);
    return make_general_engine(axis, 125e-6);
}

void expect_same_motion(const EffectTerm& one, const EffectTerm& other) {
    const auto a = engine_of(one), b = engine_of(other);
    for (int i = 0; i < 2000; ++i) {
        const double torque = 0.01 * std::sin(0.01 * i);
        a->step(torque), b->step(torque);
        ASSERT_NEAR(a->velocity, b->velocity, 1e-9) << i;
        ASSERT_NEAR(a->position, b->position, 1e-9) << i;
    }
    EXPECT_GT(std::abs(a->position), 0.01);
}

TEST(CustomSimulated, IsTheBuiltInLawWhereItSaysTheSame) {
    expect_same_motion(custom("D*v", {{"D", 1e-3}}), {"viscous", {{"coefficient", 1e-3}}, {}, {}});
    expect_same_motion(custom("k*(theta-x)", {{"k", 2e-3}, {"x", 0.3}}),
                       {"spring", {{"stiffness", 2e-3}, {"rest_position", 0.3}}, {}, {}});
    expect_same_motion(custom("c*v*abs(v)", {{"c", 1e-5}}),
                       {"quadratic_drag", {{"coefficient", 1e-5}}, {}, {}});
}

// A mass is a law in the acceleration: solved with what it causes.
TEST(CustomSimulated, LawsInTheAccelerationAreSolved) {
    AxisDescription heavy, light;
    heavy.inertia = 1.5e-5, light.inertia = 1e-5;
    const EffectTerm mass = custom("m*a", {{"m", 0.5e-5}});
    find_effect(mass.name)->add_to(light, mass);
    for (AxisDescription* axis : {&heavy, &light})
        axis->coulomb_forward = axis->coulomb_reverse = 2e-3;
    const auto a = make_general_engine(heavy, 125e-6), b = make_general_engine(light, 125e-6);
    int rests = 0;
    for (int i = 0; i < 4000; ++i) {
        const double torque = 0.01 * std::sin(0.01 * i);
        a->step(torque), b->step(torque);
        ASSERT_NEAR(a->velocity, b->velocity, 1e-9) << i;
        rests += b->stuck;
    }
    EXPECT_GT(rests, 10);
}

TEST(CustomSimulated, AnAccelerationThatLeadsToNoneIsAnError) {
    const Model model = motor({custom("k*sign(a)", {{"k", 1e-3}})});
    try {
        move(model);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::refused);
        EXPECT_NE(std::string(error.what()).find("cannot be solved for it at t = "),
                  std::string::npos)
            << error.what();
    }
}

TEST(CustomSimulated, ALawWithoutAValueIsAnError) {
    const Model model = motor({custom("k*sqrt(1-theta)", {{"k", 1e-3}})});
    try {
        move(model);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::refused);
        EXPECT_NE(std::string(error.what())
                      .find("custom.x = k*sqrt(1-theta) has no finite value at theta = 1"),
                  std::string::npos)
            << error.what();
    }
}

TEST(CustomFitted, CubicSpring) {
    const Model truth = motor({custom("k*theta^3", {{"k", 2e-4}})});
    const Capture capture = move(truth, 1e-3);
    Model wrong = truth;
    wrong.inertia *= 2, wrong.effects[1].parameters["k"] = -1e6; // linear: no start matters
    const Fitted f = fitted(wrong, capture);
    expect_within_3_std(f["custom.x.k"], 2e-4);
    expect_within_3_std(f["viscous.coefficient"], 0.75e-4);
    EXPECT_LT(f.fit.torque_error, 1.1 * f.floor);
    EXPECT_EQ(unit_of(f["custom.x.k"].quantity, Motion::rotary), "");
}

TEST(CustomFitted, CubicDragAsGoodAsABuiltInLaw) {
    const Model truth = motor({custom("c*v^3", {{"c", 1e-7}})});
    const Model built_in = motor({{"quadratic_drag", {{"coefficient", 5e-6}}, {}, {}}});
    const Fitted f = fitted(truth, move(truth, 1e-3));
    const Fitted other = fitted(built_in, move(built_in, 1e-3));
    expect_within_3_std(f["custom.x.c"], 1e-7);
    EXPECT_LT(f.fit.torque_error / f.floor, 1.05 * other.fit.torque_error / other.floor);
}

TEST(CustomFitted, ShapesAreFoundFromStartsThirtyTimesOff) {
    const Model truth = motor({custom("k*tanh(v/vs)", {{"k", 6e-3}, {"vs", 8}})});
    const Capture capture = move(truth, 1e-3);
    for (double start : {0.253, 0.8, 8.0, 80.0, 253.0}) {
        Model wrong = truth;
        wrong.effects[1].parameters = {{"k", 1}, {"vs", start}};
        const Fitted f = fitted(wrong, capture);
        expect_within_3_std(f["custom.x.k"], 6e-3);
        expect_within_3_std(f["custom.x.vs"], 8);
    }
}

// The search passes shapes at which the law has no value.
TEST(CustomFitted, ShapesWithoutAValueAreLeftAside) {
    const Model truth = motor({custom("k*sqrt(x-theta)", {{"k", 5e-3}, {"x", 8}})});
    const Fitted f =
        fitted(motor({custom("k*sqrt(x-theta)", {{"k", 1}, {"x", 60}})}), move(truth, 1e-3));
    expect_within_3_std(f["custom.x.k"], 5e-3);
    expect_within_3_std(f["custom.x.x"], 8);
}

TEST(CustomFitted, APlaceMayLieOnEitherSide) {
    const Capture capture =
        move(motor({custom("k*(theta-x)^3", {{"k", 2e-4}, {"x", -0.4}})}), 1e-3);
    for (double start : {0.0, 1.0, -1.0}) {
        const Fitted f =
            fitted(motor({custom("k*(theta-x)^3", {{"k", 1}, {"x", start}})}), capture);
        expect_within_3_std(f["custom.x.x"], -0.4);
    }
}

TEST(CustomFitted, OnlyAShape) {
    const Model truth = motor({custom("k^2*v*abs(v)", {{"k", 3e-3}})});
    const Capture capture = move(truth, 1e-3);
    Model wrong = truth;
    wrong.effects[1].parameters["k"] = 1e-3;
    const Fitted f = fitted(wrong, capture);
    expect_within_3_std(f["custom.x.k"], 3e-3);
    EXPECT_LT(f.fit.torque_error, 1.1 * f.floor);
}

// The torque that a law depends on is the model's own, with that law in it.
TEST(CustomFitted, LawInTheTorque) {
    const Model truth = motor({custom("mu*abs(T)*tanh(v/0.5)", {{"mu", 0.2}})});
    const Capture capture = move(truth);
    for (double start : {0.0, 1.0, -3.0}) {
        Model wrong = truth;
        wrong.effects[1].parameters["mu"] = start;
        const Fitted f = fitted(wrong, capture);
        EXPECT_NEAR(f["custom.x.mu"].estimate.value, 0.2, 1e-3) << start;
        EXPECT_LT(f.fit.torque_error, 1.5e-3) << start; // 14 % without the law
    }
}

TEST(CustomFitted, LawInTimeAndInAcceleration) {
    const Model warms = motor({custom("k*(1-exp(-t/tau))*v", {{"k", 1e-4}, {"tau", 0.4}})});
    Model wrong = warms;
    wrong.effects[1].parameters = {{"k", 1}, {"tau", 1}};
    const Fitted f = fitted(wrong, move(warms, 1e-3));
    expect_within_3_std(f["custom.x.tau"], 0.4);
    const Model heavy = motor({custom("m*a*cos(theta)", {{"m", 3e-6}})});
    expect_within_3_std(fitted(heavy, move(heavy, 1e-3))["custom.x.m"], 3e-6);
}

TEST(CustomFitted, FixedParametersStay) {
    const Capture capture = move(motor({custom("k*theta^3", {{"k", 2e-4}})}), 1e-3);
    const Fitted f = fitted(motor({custom("k*theta^3", {{"k", 3e-4}}, {"k"})}), capture);
    EXPECT_EQ(f["custom.x.k"].estimate.value, 3e-4);
    EXPECT_TRUE(f["custom.x.k"].fixed);
    EXPECT_GT(f.fit.torque_error, 2 * f.floor);
    const Fitted shape =
        fitted(motor({custom("k*abs(theta)^n*sign(theta)", {{"k", 1}, {"n", 2}}, {"n"})}), capture);
    EXPECT_EQ(shape["custom.x.n"].estimate.value, 2);
}

TEST(CustomFitted, SeveralLawsInOneModel) {
    Model truth = motor({custom("k*theta^3", {{"k", 2e-4}}), custom("w", {{"w", 3e-3}})});
    truth.effects[2].name = "custom.offset";
    const Fitted f = fitted(truth, move(truth, 1e-3));
    expect_within_3_std(f["custom.x.k"], 2e-4);
    expect_within_3_std(f["custom.offset.w"], 3e-3);
}

TEST(CustomRefused, ALawWithoutAValueOnTheMotion) {
    const Capture capture = move(motor());
    const Model model = motor({custom("k*sqrt(theta-1)", {{"k", 0}})});
    EXPECT_NE(refusal(model, capture)
                  .find("custom.x = k*sqrt(theta-1) has no finite value at "
                        "theta = "),
              std::string::npos)
        << refusal(model, capture);
    EXPECT_THROW(compare(model, prepare_all({&capture, 1}, {})), Refusal);
}

TEST(CustomRefused, PositionThatWasNotRecorded) {
    Capture capture = sampled([](const Kinematics& k, double) { return k.acceleration; }, 6);
    capture.velocity.clear();
    for (double t : capture.time_s)
        capture.velocity.push_back(two_sines(t).velocity);
    capture.position.clear();
    Model model;
    model.inertia = 1;
    model.effects = {custom("k*theta", {{"k", 1}})};
    EXPECT_EQ(refusal(model, capture)
                  .find("custom.x depends on theta, and the position was not recorded"),
              0u)
        << refusal(model, capture);
}

TEST(CustomRefused, ParametersThatNothingTellsApart) {
    const Capture capture = move(motor({custom("k*theta^3", {{"k", 2e-4}})}), 1e-3);
    const auto reason = [&](const std::string& law, const std::map<std::string, double>& start) {
        return refusal(motor({custom(law, start)}), capture);
    };
    EXPECT_NE(reason("p*q*theta^3", {{"p", 1}, {"q", 1}}).find("cannot tell custom.x.q from"),
              std::string::npos);
    EXPECT_NE(reason("k*(theta-3)^n", {{"k", 1}, {"n", 3}}).find("no finite value beside n = 3"),
              std::string::npos);
    EXPECT_NE(reason("k*a+c*theta^3", {{"k", 1}, {"c", 1}}).find("cannot tell these apart"),
              std::string::npos);
}

TEST(CustomAdded, FromTheCommandLine) {
    const EffectTerm term = parse_custom("custom.s = k*tanh(v/vs) ; vs=0.1");
    EXPECT_EQ(term.name, "custom.s");
    EXPECT_EQ(term.law, "k*tanh(v/vs)");
    EXPECT_EQ(term.parameters, (std::map<std::string, double>{{"k", 1}, {"vs", 0.1}}));
    EXPECT_TRUE(is_custom("custom.s=v"));
    EXPECT_TRUE(is_custom("custom"));
    EXPECT_FALSE(is_custom("viscous"));
}

TEST(CustomAdded, WrongArgumentsSayWhatWasExpected) {
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"custom", "custom needs a name and a law; expected for example 'custom.cubic="},
        {"custom=k*v", "custom needs a name and a law"},
        {"custom.s", "custom needs a name and a law"},
        {"custom.=k*v", "cannot be the name of a law"},
        {"custom.a b=k*v", "cannot be the name of a law"},
        {"custom.s=", "custom.s: the law is empty"},
        {"custom.s=k*sinh(v)", "custom.s: the law has an unknown function \"sinh\""},
        {"custom.s=k**v", "custom.s: the law cannot be read"},
        {"custom.s=k*v;c=2", "custom.s: the law has no parameter \"c\""},
        {"custom.s=k*v;k", "custom.s: \"k\" is no start value; expected one such as vs=0.1"},
        {"custom.s=k*v;k=x", "custom.s: \"k=x\" is no start value"},
    };
    for (const auto& [argument, message] : wrong)
        try {
            parse_custom(argument);
            ADD_FAILURE() << argument;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
}

// Without the law the inertia would come out negative: no error before, but one after.
// The cubic spring turns the inertia's sign where the model lacks it: the inertia is then held.
TEST(CustomAdded, WhereTheModelWithoutItKeepsItsInertia) {
    const Capture capture = move(motor({custom("k*theta^3", {{"k", 2e-4}})}), 1e-3);
    const Addition a =
        add_term(motor(), custom("k*theta^3", {{"k", 1}}), prepare_all({&capture, 1}, {}));
    EXPECT_EQ(a.before.model.inertia, motor().inertia);
    EXPECT_GT(a.before.torque_error, 0.5);
    EXPECT_NEAR(a.after.model.effects[1].at("k"), 2e-4, 1e-6);
}

TEST(CustomDiagnosed, IsKeptAndNeverTried) {
    const Model truth =
        motor({custom("k*theta^3", {{"k", 2e-4}}), {"coulomb", {{"torque", 8e-3}}, {}, {}}});
    const Capture capture = move(truth, 1e-3);
    Model lacking = truth;
    lacking.effects.pop_back();
    const Diagnosis d = diagnose(lacking, prepare_all({&capture, 1}, {}));
    ASSERT_FALSE(d.candidates.empty());
    EXPECT_EQ(d.candidates[0].effect, "coulomb");
    EXPECT_NEAR(d.candidates[0].fit.model.effects[1].at("k"), 2e-4, 2e-6);
    for (const Candidate& c : d.candidates)
        EXPECT_NE(c.effect, "custom");
}

TEST(CustomFile, RoundTrip) {
    Model model = motor(
        {custom("k*tanh(v/vs)", {{"k", 0.1}, {"vs", 1e-7}}, {"vs"}), custom("0.1*sin(7*theta)")});
    model.effects[2].name = "custom.wave-7_b";
    const std::string text = format_model(model);
    const Model back = parse_model(text, "m.toml");
    ASSERT_EQ(back.effects.size(), 3u) << text;
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back.effects[i].name, model.effects[i].name);
        EXPECT_EQ(back.effects[i].law, model.effects[i].law);
        EXPECT_EQ(back.effects[i].parameters, model.effects[i].parameters);
        EXPECT_EQ(back.effects[i].fixed, model.effects[i].fixed);
    }
    EXPECT_EQ(format_model(back), text);
}

// An array of tables is allowed for effects that may occur more than once, so here too.
TEST(CustomFile, TheSameNameTwice) {
    const std::string text = "motion = \"rotary\"\n\n[plant]\ninertia = 1.0\n\n"
                             "[[effects.custom.x]]\nlaw = \"k*v\"\n\n"
                             "[effects.custom.x.parameters]\nk = 1.0\n\n"
                             "[[effects.custom.x]]\nlaw = \"c*v^3\"\n\n"
                             "[effects.custom.x.parameters]\nc = 2.0\n";
    const Model model = parse_model(text, "m.toml");
    ASSERT_EQ(model.effects.size(), 2u);
    EXPECT_EQ(model.effects[1].law, "c*v^3");
    EXPECT_EQ(term_name(model, 1), "custom.x#2");
    EXPECT_EQ(format_model(model), text);
}

} // namespace
