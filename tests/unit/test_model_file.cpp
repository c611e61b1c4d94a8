#include "common/error.hpp"
#include "common/text.hpp"
#include "effects/catalogue.hpp"
#include "model/model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

const std::string complete = R"(
name   = "Motor and slider"
motion = "rotary"

[plant]
inertia = 5.56e-5
fixed   = ["inertia"]

[controller]
type           = "p_pi"
position_gain  = 40
speed_gain     = 2.9154e-3
integral_time  = 0.0159155
sample_time    = 125e-6

[sensor]
counts_per_rev = 131072

[drive]
rated_torque    = 0.637
torque_constant = 1
torque_limit    = 1.9

[effects.coulomb]
torque = 2.1e-2

[effects.viscous]
coefficient = 9.6e-4
fixed = ["coefficient"]
)";

std::string error_of(const std::string& text) {
    try {
        parse_model(text, "m.toml");
        return "";
    } catch (const FileError& error) {
        return error.what();
    }
}

TEST(ModelFile, ReadsEveryKey) {
    const Model model = parse_model(complete, "m.toml");
    EXPECT_EQ(model.name, "Motor and slider");
    EXPECT_EQ(model.motion, Motion::rotary);
    EXPECT_EQ(model.inertia, 5.56e-5);
    EXPECT_TRUE(model.inertia_fixed);
    ASSERT_TRUE(model.controller.has_value());
    EXPECT_EQ(model.controller->type, Controller::Type::p_pi);
    EXPECT_EQ(model.controller->position_gain_per_s, 40.0);
    EXPECT_EQ(model.controller->speed_gain, 2.9154e-3);
    EXPECT_EQ(model.controller->integral_time_s, 0.0159155);
    EXPECT_EQ(model.controller->sample_time_s, 125e-6);
    EXPECT_EQ(model.controller->speed_average, 1);
    EXPECT_EQ(model.sensor.position_per_count, 2 * std::numbers::pi / 131072);
    EXPECT_EQ(model.drive.rated_torque, 0.637);
    EXPECT_EQ(model.drive.torque_constant, 1.0);
    EXPECT_EQ(model.drive.torque_limit, 1.9);
    ASSERT_EQ(model.effects.size(), 2u);
    EXPECT_EQ(model.effects[0].name, "coulomb") << "the order of the file, not of the alphabet";
    EXPECT_EQ(model.effects[0].at("torque"), 2.1e-2);
    EXPECT_FALSE(model.effects[0].is_fixed("torque"));
    EXPECT_TRUE(model.effects[1].is_fixed("coefficient"));
    EXPECT_EQ(model.find("viscous"), &model.effects[1]);
    EXPECT_EQ(model.find("gravity"), nullptr);
    EXPECT_THROW(static_cast<void>(model.effects[0].at("coefficient")), std::out_of_range);
}

TEST(ModelFile, EffectsKeepTheOrderOfTheFile) {
    const std::string head = "motion = \"linear\"\n[plant]\ninertia = 95\n";
    const Model model = parse_model(head + "[effects.viscous]\ncoefficient = 1\n"
                                           "[effects.constant_torque]\ntorque = -3.1\n"
                                           "[effects.coulomb]\ntorque = 20\n",
                                    "m.toml");
    ASSERT_EQ(model.effects.size(), 3u);
    EXPECT_EQ(model.effects[0].name, "viscous");
    EXPECT_EQ(model.effects[1].name, "constant_torque");
    EXPECT_EQ(model.effects[2].name, "coulomb");
}

TEST(ModelFile, SmallestModel) {
    const Model model = parse_model("motion = \"linear\"\nplant.inertia = 95", "m.toml");
    EXPECT_EQ(model.motion, Motion::linear);
    EXPECT_EQ(model.inertia, 95);
    EXPECT_FALSE(model.controller.has_value());
    EXPECT_EQ(model.sensor.position_per_count, 0);
}

TEST(ModelFile, PPLoopWithAveragedSpeed) {
    const Model model = parse_model("motion = \"linear\"\nplant.inertia = 95\n"
                                    "[controller]\ntype = \"p_p\"\nposition_gain = 160.18\n"
                                    "speed_gain = 8557.4\nsample_time = 1e-3\nspeed_average = 2\n"
                                    "[sensor]\nmetres_per_count = 5e-8\n",
                                    "m.toml");
    EXPECT_EQ(model.controller->type, Controller::Type::p_p);
    EXPECT_EQ(model.controller->integral_time_s, 0);
    EXPECT_EQ(model.controller->speed_average, 2);
    EXPECT_EQ(model.sensor.position_per_count, 5e-8);
}

TEST(ModelFile, ErrorsCarryTheLineAndTheNearestName) {
    EXPECT_EQ(error_of("motion = \"rotary\"\n[plant]\ninertial = 1\n"),
              "m.toml:3: unknown key \"plant.inertial\"; did you mean \"inertia\"?");
    EXPECT_EQ(error_of("motion = \"rotary\"\n[plant]\ninertia = -1\n"),
              "m.toml:3: plant.inertia must be above zero, not -1");
}

// What a text editor does to the file must not change what is read.
TEST(ModelFile, BomAndWindowsLineEndings) {
    std::string windows = "\xef\xbb\xbf";
    for (const char c : complete)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(format_model(parse_model(windows, "w")), format_model(parse_model(complete, "u")));
}

double random_number(std::mt19937_64& random, double lower, double upper) {
    std::uniform_real_distribution<double> unit(0, 1), decade(-12, 12);
    if (std::isfinite(lower) && std::isfinite(upper)) return lower + (upper - lower) * unit(random);
    const double magnitude = (1 + unit(random)) * std::pow(10.0, decade(random));
    if (std::isfinite(lower)) return lower + magnitude;
    if (std::isfinite(upper)) return upper - magnitude;
    return unit(random) < 0.5 ? -magnitude : magnitude;
}

double positive(std::mt19937_64& random) { return random_number(random, 0, INFINITY); }
bool coin(std::mt19937_64& random) { return random() % 2 == 0; }

// cannot_add() lets an effect in that takes the place of another one; a file holds only one of
// them.
bool fits(const Effect& effect, const Model& model) {
    for (const auto& replaced : effect.info().replaces)
        if (model.find(replaced)) return false;
    return cannot_add(effect, model).empty();
}

EffectTerm random_term(std::mt19937_64& random, const Effect& effect, Motion motion) {
    EffectTerm term;
    term.name = effect.info().name;
    const bool in_metres = motion == Motion::linear && coin(random);
    if (in_metres) term.parameters["period"] = 0; // effects with an order take it instead
    const std::vector<ParameterInfo> parameters = effect.parameters(term);
    term.parameters.clear();
    for (const auto& parameter : parameters) {
        term.parameters[parameter.key] = random_number(random, parameter.lower, parameter.upper);
        if (coin(random)) term.fixed.push_back(parameter.key);
    }
    return term;
}

Model random_model(std::mt19937_64& random) {
    Model model;
    const std::string letters = "ab\"\\\n\t=#[]'\x7f \xc3\xa4";
    if (coin(random)) model.name = letters.substr(random() % 8) + "x";
    model.motion = coin(random) ? Motion::linear : Motion::rotary;
    model.inertia = positive(random);
    model.inertia_fixed = coin(random);
    if (coin(random)) {
        Controller controller;
        controller.type = coin(random) ? Controller::Type::p_pi : Controller::Type::p_p;
        controller.position_gain_per_s = positive(random);
        controller.speed_gain = positive(random);
        if (controller.type == Controller::Type::p_pi)
            controller.integral_time_s = positive(random);
        controller.sample_time_s = positive(random);
        controller.speed_average = 1 + static_cast<int>(random() % 4);
        model.controller = controller;
    }
    if (coin(random)) {
        // A gear makes the counts of a turn a fraction.
        const double whole = 1 + static_cast<double>(random() >> (random() % 60));
        const double counts = coin(random) ? whole : positive(random);
        const bool linear = model.motion == Motion::linear;
        model.sensor.position_per_count = linear ? positive(random) : 2 * std::numbers::pi / counts;
    }
    if (coin(random)) model.drive = {positive(random), positive(random), positive(random)};
    for (const Effect* effect : catalogue()) {
        if (effect->info().name == "custom") continue;
        for (int repeat = 0; repeat < (effect->info().repeatable ? 2 : 1); ++repeat)
            if (coin(random) && fits(*effect, model))
                model.effects.push_back(random_term(random, *effect, model.motion));
    }
    return model;
}

void expect_same(const Model& a, const Model& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.motion, b.motion);
    EXPECT_EQ(a.inertia, b.inertia);
    EXPECT_EQ(a.inertia_fixed, b.inertia_fixed);
    EXPECT_EQ(a.sensor.position_per_count, b.sensor.position_per_count);
    EXPECT_EQ(a.drive.rated_torque, b.drive.rated_torque);
    EXPECT_EQ(a.drive.torque_constant, b.drive.torque_constant);
    EXPECT_EQ(a.drive.torque_limit, b.drive.torque_limit);
    ASSERT_EQ(a.controller.has_value(), b.controller.has_value());
    if (a.controller) {
        EXPECT_EQ(a.controller->type, b.controller->type);
        EXPECT_EQ(a.controller->position_gain_per_s, b.controller->position_gain_per_s);
        EXPECT_EQ(a.controller->speed_gain, b.controller->speed_gain);
        EXPECT_EQ(a.controller->integral_time_s, b.controller->integral_time_s);
        EXPECT_EQ(a.controller->sample_time_s, b.controller->sample_time_s);
        EXPECT_EQ(a.controller->speed_average, b.controller->speed_average);
    }
    ASSERT_EQ(a.effects.size(), b.effects.size());
    for (size_t i = 0; i < a.effects.size(); ++i) {
        EXPECT_EQ(a.effects[i].name, b.effects[i].name);
        EXPECT_EQ(a.effects[i].parameters, b.effects[i].parameters);
        EXPECT_EQ(a.effects[i].fixed, b.effects[i].fixed);
        EXPECT_EQ(a.effects[i].law, b.effects[i].law);
    }
}

TEST(ModelFile, RandomModelsReadBackExactly) {
    for (unsigned seed = 1; seed <= 2000 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        const Model model = random_model(random);
        const std::string text = format_model(model);
        SCOPED_TRACE(text);
        ASSERT_NO_THROW(expect_same(parse_model(text, "random"), model));
        EXPECT_EQ(format_model(parse_model(text, "random")), text);
    }
}

const std::string linear_axis = "motion = \"linear\"\n\n[plant]\ninertia = 95.0\n\n";

TEST(ModelFile, PeriodInMetresInPlaceOfAnOrder) {
    const std::string screw = "[[effects.cogging]]\namplitude = 1.5\nperiod    = 0.0025\n"
                              "phase     = 0.5\nfixed     = [\"period\"]\n";
    const Model model = parse_model(linear_axis + screw, "m.toml");
    ASSERT_EQ(model.effects.size(), 1u);
    EXPECT_EQ(model.effects[0].at("period"), 0.0025);
    EXPECT_FALSE(model.effects[0].parameters.contains("order"));
    EXPECT_TRUE(model.effects[0].is_fixed("period"));
    EXPECT_EQ(format_model(model), linear_axis + screw) << "written as it was read";
    for (const char* name : {"torque_ripple", "variable_inertia"})
        EXPECT_EQ(error_of(linear_axis + "[effects." + name +
                           "]\nfraction = 0.1\nperiod = 0.0025\nphase = 0\n"),
                  "");
}

TEST(ModelFile, PeriodWhereItHasNoPlace) {
    const std::string both = "[effects.cogging]\namplitude = 1.5\nperiod = 0.0025\norder = 400\n";
    EXPECT_EQ(error_of(linear_axis + both + "phase = 0\n"),
              "m.toml:9: effects.cogging.order and period say the same; keep one of them");
    EXPECT_EQ(error_of("motion = \"rotary\"\n[plant]\ninertia = 1\n[effects.cogging]\n"
                       "amplitude = 1\nperiod = 0.0025\nphase = 0\n"),
              "m.toml:6: effects.cogging.period is for a linear axis; expected order, in cycles "
              "per revolution");
    EXPECT_EQ(error_of(linear_axis + "[effects.cogging]\namplitude = 1\nperiod = 0\nphase = 0\n"),
              "m.toml:8: effects.cogging.period = 0 is out of bounds; expected at least 1e-09");
    EXPECT_NE(error_of(linear_axis + "[effects.viscous]\ncoefficient = 1\nperiod = 0.0025\n")
                  .find("unknown key"),
              std::string::npos);
}

TEST(ModelFile, CustomEffects) {
    const std::string text = "motion = \"rotary\"\n\n[plant]\ninertia = 1.0\n\n"
                             "[effects.custom.drag]\nlaw   = \"c*v^3\"\nfixed = [\"c\"]\n\n"
                             "[effects.custom.drag.parameters]\nc = 0.25\n";
    const Model model = parse_model(text, "m.toml");
    ASSERT_EQ(model.effects.size(), 1u);
    EXPECT_EQ(model.effects[0].name, "custom.drag");
    EXPECT_EQ(model.effects[0].law, "c*v^3");
    EXPECT_EQ(model.effects[0].at("c"), 0.25);
    EXPECT_TRUE(model.effects[0].is_fixed("c"));
    EXPECT_EQ(format_model(model), text);
}

// The parser aborts on these when it is used as it comes.
TEST(ModelFile, KeysInOtherAlphabetsAreErrors) {
    for (const auto* text : {"[\xc3\xa4]\n", "[a.\xc3\xa4]\n", "[[\xc3\xa4]]\n", "a.\xc3\xa4 = 1\n",
                             "\xc3\xa4 = 1\n", "x = {\xc3\xa4 = 1}\n"})
        EXPECT_EQ(error_of(text).rfind("m.toml:1: not valid TOML", 0), 0u)
            << text << error_of(text);
}

TEST(ModelFile, EveryCutOffModelIsReadOrRefusedButNeverCrashes) {
    for (size_t length = 0; length < complete.size(); ++length) {
        const std::string error = error_of(complete.substr(0, length));
        EXPECT_TRUE(error.empty() || error.starts_with("m.toml")) << error;
    }
}

TEST(ModelFile, RandomDamageIsReadOrRefusedButNeverCrashes) {
    for (unsigned seed = 1; seed <= 3000; ++seed) {
        std::mt19937_64 random(seed);
        std::string text = complete;
        for (int i = 0; i < 3; ++i)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        EXPECT_NO_THROW(error_of(text)) << "seed " << seed;
    }
}

} // namespace
