// What a capture cannot show is said, and one that cannot answer at all is `insufficient`.
#include "compare/compare.hpp"
#include "diagnose/diagnose.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace servoid;

namespace {

Model motor(const std::vector<std::string>& without = {}) {
    Model out = read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system1.toml");
    std::erase_if(out.effects, [&](const EffectTerm& e) {
        return std::find(without.begin(), without.end(), e.name) != without.end();
    });
    return out;
}

// A diagnosis with the captures that it points into.
struct Answer {
    Answer(const Model& model, Capture capture)
        : captures{std::move(capture)}, d(diagnose(model, prepare_all(captures, {}))) {}
    std::vector<Capture> captures;
    Diagnosis d;

    const Unseen* unseen(const std::string& effect) const {
        for (const Unseen& u : d.cannot_show)
            if (u.effect == effect) return &u;
        return nullptr;
    }
    const Candidate& candidate(const std::string& effect) const {
        return *std::find_if(d.candidates.begin(), d.candidates.end(),
                             [&](const Candidate& c) { return c.effect == effect; });
    }
};

Capture simulated(const char* move) { return simulate(motor(), parse_experiment(move), 3); }

// The rows between two instants, counted from the first.
Capture cut(const Capture& all, double from_s, double to_s) {
    Capture out = all;
    const auto first = long(from_s / all.sample_time_s), last = long(to_s / all.sample_time_s);
    for (std::vector<double>* column :
         {&out.time_s, &out.position, &out.position_ref, &out.torque_ref})
        *column = std::vector<double>(column->begin() + first, column->begin() + last);
    for (double& t : out.time_s)
        t -= from_s;
    out.period_s.reset();
    return out;
}

// Forth only, with its acceleration and braking.
Capture one_way() {
    return cut(simulated("trapezoid:stroke=20,velocity=30,acceleration=200,cycles=1,"
                         "torque_noise=1e-3"),
               0, 0.81);
}

} // namespace

TEST(Unseen, OneWayCoulombAndConstantTorqueAreTheSame) {
    const Answer a(motor({"coulomb"}), one_way());
    EXPECT_EQ(a.d.verdict, Verdict::ambiguous);
    const Candidate &coulomb = a.candidate("coulomb"), &constant = a.candidate("constant_torque");
    EXPECT_EQ(coulomb.probability, constant.probability);
    EXPECT_GT(coulomb.probability, 0.4);
    EXPECT_EQ(coulomb.note, "the same as constant_torque on one-way motion");
    EXPECT_EQ(constant.note, "the same as coulomb on one-way motion");
    ASSERT_TRUE(a.unseen("coulomb") && a.unseen("constant_torque"));
    EXPECT_NE(a.unseen("coulomb")->record.find("both directions"), std::string::npos);
}

// Where one of them is believed the other is no finding.
TEST(Unseen, OneWayTheOtherNameOfWhatIsThereIsNoFinding) {
    const Answer a(motor(), one_way());
    EXPECT_FALSE(a.candidate("constant_torque").sound);
    EXPECT_EQ(a.candidate("constant_torque").note, "the same as coulomb on one-way motion");
    EXPECT_NE(a.d.verdict, Verdict::missing);
}

TEST(Unseen, BothWaysTheyAreNot) {
    const Answer a(motor({"coulomb"}),
                   simulated("trapezoid:stroke=6.28,velocity=40,cycles=4,torque_noise=1e-3"));
    EXPECT_EQ(a.d.verdict, Verdict::missing);
    EXPECT_FALSE(a.unseen("coulomb"));
    EXPECT_FALSE(a.unseen("constant_torque"));
    EXPECT_FALSE(a.d.shortage);
}

TEST(Unseen, LessThanATurn) {
    const Answer a(motor(), simulated("trapezoid:stroke=1,velocity=20,cycles=4,torque_noise=1e-3"));
    for (const char* effect : {"cogging", "encoder_eccentricity", "gravity"}) {
        if (a.candidate(effect).sound) continue;
        ASSERT_TRUE(a.unseen(effect)) << effect;
        EXPECT_EQ(a.unseen(effect)->why, "less than a full turn");
        EXPECT_NE(a.unseen(effect)->record.find("full turns"), std::string::npos);
    }
}

TEST(Unseen, WithoutPositions) {
    Capture c = simulated("trapezoid:stroke=6.28,velocity=40,cycles=4");
    c.velocity.assign(c.rows(), 0);
    for (size_t i = 1; i < c.rows(); ++i)
        c.velocity[i] = (c.position[i] - c.position[i - 1]) / c.sample_time_s;
    c.position.clear();
    const Answer a(motor(), std::move(c));
    for (const char* effect : {"cogging", "spring", "hard_stop"}) {
        ASSERT_TRUE(a.unseen(effect)) << effect;
        EXPECT_EQ(a.unseen(effect)->why, "the position was not recorded") << effect;
    }
}

TEST(Unseen, GainAndAntiresonanceAreAlwaysSaid) {
    const Answer a(motor(),
                   simulated("trapezoid:stroke=6.28,velocity=40,cycles=4,torque_noise=1e-3"));
    ASSERT_TRUE(a.unseen("torque_gain"));
    EXPECT_NE(a.unseen("torque_gain")->why.find("inertia"), std::string::npos);
    ASSERT_TRUE(a.unseen("elastic_load"));
    EXPECT_NE(a.unseen("elastic_load")->why.find("Hz"), std::string::npos);
    for (const Unseen& u : a.d.cannot_show)
        EXPECT_FALSE(u.why.empty() || u.record.empty()) << u.effect;
}

TEST(Insufficient, OneConstantSpeed) {
    const Answer a(motor(), cut(simulated("trapezoid:stroke=20,velocity=30,cycles=1,"
                                          "torque_noise=1e-3"),
                                0.05, 0.6));
    EXPECT_EQ(a.d.verdict, Verdict::insufficient);
    ASSERT_TRUE(a.d.shortage);
    EXPECT_NE(a.d.shortage->why.find("one constant speed"), std::string::npos);
    EXPECT_NE(a.d.advice.find("record instead: "), std::string::npos);
}

TEST(Insufficient, AFewCounts) {
    Model coarse = motor();
    coarse.sensor.position_per_count = 2 * std::numbers::pi / 1000;
    const Answer a(motor(), simulate(coarse,
                                     parse_experiment("sine:frequency_Hz=2,amplitude=0.02,"
                                                      "periods=8"),
                                     3));
    EXPECT_EQ(a.d.verdict, Verdict::insufficient) << a.d.advice;
    EXPECT_NE(a.d.advice.find("counts"), std::string::npos) << a.d.advice;
}

TEST(Insufficient, AGoodMoveIsEnough) {
    const Answer a(motor(),
                   simulated("trapezoid:stroke=6.28,velocity=40,cycles=4,torque_noise=1e-3"));
    EXPECT_EQ(a.d.verdict, Verdict::adequate);
    EXPECT_FALSE(a.d.shortage);
}
