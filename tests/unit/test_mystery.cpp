// A hidden effect: chosen by its seed alone, strong enough to be seen, and kept as a secret that
// tells the truth.
#include "common/error.hpp"
#include "effects/catalogue.hpp"
#include "mystery/mystery.hpp"
#include "mystery/secret.hpp"
#include "mystery/strength.hpp"
#include "plant/simulate.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <set>

using namespace servoid;

namespace {

using Vector = Eigen::VectorXd;

const std::string move = "trapezoid:stroke=12.56,velocity=50,cycles=4,torque_noise=1e-3";

Model example(const std::string& name) {
    return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/" + name);
}

bool same(const Mystery& a, const Mystery& b) {
    return a.hidden.name == b.hidden.name && a.hidden.parameters == b.hidden.parameters;
}

// --- strength, measured once more: no torque view, no fit of the program ----------------------

// Three moving averages: half its height at the band edge, no phase.
Vector smoothed(Vector x, double step_s, double band_Hz) {
    const auto width = Eigen::Index(0.36 / band_Hz / step_s) | 1;
    for (int pass = 0; pass < 3; ++pass) {
        Vector sum(x.size() + 1);
        sum[0] = 0;
        for (Eigen::Index i = 0; i < x.size(); ++i)
            sum[i + 1] = sum[i] + x[i];
        x = (sum.tail(x.size() + 1 - width) - sum.head(x.size() + 1 - width)) / double(width);
    }
    return x;
}

// What inertia, viscous, Coulomb friction and a constant leave of the torque, as a share of it; the
// hidden law itself aside. Where the axis rests, friction holds whatever it has to: left out.
double left_of(const Capture& c, const std::string& hidden, double band_Hz) {
    const double h = c.sample_time_s;
    const auto n = Eigen::Index(c.rows());
    const Vector x = Eigen::Map<const Vector>(c.position.data(), n);
    const Vector torque = Eigen::Map<const Vector>(c.torque_ref.data(), n).segment(8, n - 16);
    const auto at = [&](Eigen::Index by) { return Vector(x.segment(8 + by, n - 16)); };
    const Vector speed = (at(8) - at(-8)) / (16 * h);
    std::vector<Vector> laws = {(at(8) - 2 * at(0) + at(-8)) / (64 * h * h)};
    if (hidden != "viscous") laws.push_back(speed);
    if (hidden != "coulomb") laws.push_back(speed.cwiseSign());
    if (hidden != "constant_torque") laws.push_back(Vector::Ones(n - 16));
    const double slow = 1e-3 * speed.cwiseAbs().maxCoeff();
    const Vector rests = smoothed((speed.array().abs() < slow).cast<double>().matrix(), h, band_Hz);
    const Vector moving = (rests.array() < 0.01).cast<double>();
    const Vector target = smoothed(torque, h, band_Hz).cwiseProduct(moving);
    Eigen::MatrixXd columns(target.size(), Eigen::Index(laws.size()));
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
        columns.col(i) = smoothed(laws[size_t(i)], h, band_Hz).cwiseProduct(moving).normalized();
    return (target - columns * columns.colPivHouseholderQr().solve(target)).norm() / target.norm();
}

double share_of(const Model& model, const Mystery& m, const std::string& experiment) {
    const Experiment e = parse_experiment(experiment);
    const std::string& name = m.hidden.name;
    const double with = left_of(simulate(with_hidden(model, m.hidden), e, 1), name, m.band_Hz);
    const double without = left_of(simulate(model, e, 1), name, m.band_Hz);
    return std::sqrt(std::max(0.0, with * with - without * without));
}

TEST(Mystery, SixtySeedsReachManyEffectsEachAsStrongAsItSays) {
    const Model model = example("system1.toml");
    std::set<std::string> effects;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Mystery m = make_mystery(model, parse_experiment(move), seed, 1);
        SCOPED_TRACE(m.hidden.name + ", seed " + std::to_string(seed));
        effects.insert(m.hidden.name);
        EXPECT_FALSE(model.find(m.hidden.name));
        EXPECT_GE(m.share, kLeastShare);
        EXPECT_LE(m.share, kMostShare);
        const double again = share_of(model, m, move);
        EXPECT_GE(again, 0.8 * kLeastShare);
        EXPECT_LE(again, 1.2 * kMostShare);
        EXPECT_NEAR(again / m.share, 1, 0.3) << again << " and " << m.share;
    }
    EXPECT_GE(effects.size(), 12u);
    EXPECT_FALSE(effects.contains("torque_gain"));
    EXPECT_FALSE(effects.contains("coulomb_asymmetric"));
}

TEST(Mystery, DependsOnItsSeedAndNotOnTheNoise) {
    const Model model = example("system2.toml");
    const Experiment e = parse_experiment(move);
    const Mystery first = make_mystery(model, e, 7, 1);
    EXPECT_TRUE(same(first, make_mystery(model, e, 7, 1)));
    EXPECT_TRUE(same(first, make_mystery(model, e, 7, 99)));
    EXPECT_FALSE(same(first, make_mystery(model, e, 8, 1)));
}

TEST(Mystery, TheAxisSurvivesIt) {
    const Model model = example("system2.toml");
    const Experiment e = parse_experiment(move);
    const Capture before = simulate(model, e, 1);
    const auto travel = [](const Capture& c) {
        const auto [low, high] = std::minmax_element(c.position.begin(), c.position.end());
        return *high - *low;
    };
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Mystery m = make_mystery(model, e, seed, 1);
        SCOPED_TRACE(m.hidden.name);
        const SimulatedRun run = simulate_run(with_hidden(model, m.hidden), e, 1);
        EXPECT_NEAR(travel(run.capture) / travel(before), 1, 0.4);
        EXPECT_TRUE(!run.saturated || m.hidden.name == "torque_saturation");
    }
}

TEST(Mystery, WhatStopsOrUpsetsTheAxisIsNoStrength) {
    const Model model = example("system1.toml");
    const Experiment e = parse_experiment(move);
    const Stage stage(model, e, 1);
    const auto term = [](const std::string& name, std::map<std::string, double> parameters) {
        EffectTerm out;
        out.name = name, out.parameters = std::move(parameters);
        return out;
    };
    EXPECT_TRUE(stage.strength(term("spring", {{"stiffness", 1e-3}, {"rest_position", 6}})));
    for (const EffectTerm& hidden :
         {term("spring", {{"stiffness", 10}, {"rest_position", 6}}),       // it stays where it is
          term("dead_time", {{"delay", 0.02}}),                            // the loop swings up
          term("torque_saturation", {{"limit", 1e-3}}),                    // it hardly moves
          term("quadratic_drag", {{"coefficient", 1}}),                    // it creeps
          term("encoder_eccentricity", {{"amplitude", 5}, {"phase", 0}})}) // not one position fits
        EXPECT_FALSE(stage.strength(hidden)) << hidden.name;
}

TEST(Mystery, WorksOnALinearAxis) {
    const Model model = example("emps.toml");
    const Experiment e = parse_experiment("trapezoid:stroke=0.2,velocity=0.3,acceleration=3");
    std::set<std::string> effects;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        effects.insert(make_mystery(model, e, seed, 1).hidden.name);
    EXPECT_GE(effects.size(), 3u);
    EXPECT_FALSE(effects.contains("gravity"));
}

TEST(Mystery, IsRefusedWhereTheExperimentShowsNothing) {
    const Model model = example("system1.toml");
    EXPECT_THROW(
        make_mystery(model, parse_experiment("sine:amplitude=1e-4,torque_noise=0.3"), 1, 1),
        Refusal);
}

TEST(Mystery, AHiddenEffectTakesThePlaceOfWhatItStandsFor) {
    const Model model = example("system1.toml");
    EffectTerm term;
    term.name = "viscous_asymmetric";
    const Model changed = with_hidden(model, term);
    EXPECT_FALSE(changed.find("viscous"));
    EXPECT_TRUE(changed.find("viscous_asymmetric"));
    EXPECT_TRUE(changed.find("coulomb"));
}

// --- the secret -------------------------------------------------------------------------------

TEST(Secret, Base64IsThatOfTheRfc) {
    const std::vector<std::pair<std::string, std::string>> known = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : known) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(from_base64(text), bytes);
    }
    for (const char* wrong : {"Zg", "Zg=", "Z g=", "Zm9$"})
        EXPECT_EQ(from_base64(wrong), "") << wrong;
}

TEST(Secret, ComesBackExactly) {
    Mystery m;
    m.seed = 18446744073709551615u;
    m.hidden.name = "cogging";
    m.hidden.parameters = {{"amplitude", 1.0 / 3}, {"order", 12}, {"phase", -0.1}};
    m.motion = Motion::linear;
    m.share = 0.123456789012345678, m.band_Hz = 25;
    const std::string text = encode_secret(m);
    EXPECT_EQ(text.find("cogging"), std::string::npos);
    const Mystery back = decode_secret(text, "a.csv", 3);
    EXPECT_TRUE(same(m, back));
    EXPECT_EQ(back.seed, m.seed);
    EXPECT_EQ(back.motion, m.motion);
    EXPECT_EQ(back.share, m.share);
    EXPECT_EQ(back.band_Hz, m.band_Hz);
}

TEST(Secret, DamagedOnesAreNamedWithTheirLine) {
    for (const std::string& text :
         {std::string("???"), base64("no table"), base64("seed = \"1\"\n"),
          base64("seed = \"1\"\nmotion = \"rotary\"\neffect = \"witchcraft\"\nshare = 0.1\n"
                 "band_Hz = 25\n[parameters]\n")}) {
        try {
            decode_secret(text, "a.csv", 3);
            FAIL() << text;
        } catch (const FileError& e) {
            EXPECT_TRUE(std::string(e.what()).starts_with("a.csv:3: mystery_secret is damaged"))
                << e.what();
        }
    }
}

} // namespace
