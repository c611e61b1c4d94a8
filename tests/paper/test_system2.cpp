// Table V, system 2 (motor and slider): the elastic bias of eq. (7), and one inertia without it.
#include "identify/sweep.hpp"
#include "paper/paper.hpp"

#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::paper;

namespace {

const Sweep& the_sweep() {
    static const Sweep s = sweep(system(2), {});
    return s;
}

TEST(System2, ModelFileHoldsTableII) {
    const Model m = system(2);
    EXPECT_DOUBLE_EQ(m.inertia, kInertia2);
    EXPECT_DOUBLE_EQ(m.find("viscous")->at("coefficient"), 0.96e-3);
    EXPECT_DOUBLE_EQ(m.find("coulomb")->at("torque"), 2.1e-2);
    const EffectTerm& load = *m.find("elastic_load");
    EXPECT_DOUBLE_EQ(load.at("antiresonance_frequency"), kAntiresonance_Hz);
    EXPECT_DOUBLE_EQ(load.at("resonance_frequency"), kResonance_Hz);
    EXPECT_DOUBLE_EQ(load.at("antiresonance_damping"), kDamping);
    EXPECT_DOUBLE_EQ(load.at("resonance_damping"), kDamping);
}

TEST(System2, AmplitudesOfTableV) {
    const double first = the_sweep().points.front().answer.position_amplitude;
    const double last = the_sweep().points.back().answer.position_amplitude;
    figure("system 2, position amplitude at 10 Hz", first, "rad", "0.95");
    figure("system 2, position amplitude at 200 Hz", last, "rad", "0.001");
    EXPECT_NEAR(first, 0.95, 0.01);
    EXPECT_NEAR(last, 0.001, 0.0003);
}

TEST(System2, ClosedFormOfTheBias) {
    const double asked[][2] = {{10, 0.04}, {50, 0.92}, {100, 3.86}, {150, 9.45}, {200, 19.15}};
    for (const auto& [frequency, percent] : asked) {
        const double bias = 100 * elastic_bias(frequency);
        figure(fmt::format("elastic bias of eq. (7) at {} Hz", frequency), bias, "%",
               fmt::format("{}", percent));
        EXPECT_NEAR(bias, percent, 0.006);
    }
}

TEST(System2, InertiaFollowsTheBias) {
    double worst = 0;
    for (const SweepPoint& p : the_sweep().points) {
        SCOPED_TRACE(p.answer.frequency_Hz);
        EXPECT_EQ(p.answer.reason, SID_OK);
        const double error = (p.answer.inertia / kInertia2 - 1) * 100;
        const double off = error - 100 * elastic_bias(p.answer.frequency_Hz);
        EXPECT_LE(std::abs(off), 4);
        if (std::abs(off) > std::abs(worst)) worst = off;
    }
    figure("system 2, J against the elastic bias, largest distance", worst, "points", "within ±4");
}

struct Conditions {
    double bits, noise_percent;
    unsigned long seed;
};

class CorrectedInertiaOf : public testing::TestWithParam<Conditions> {};

TEST_P(CorrectedInertiaOf, System2) {
    const Conditions& c = GetParam();
    SweepOptions options;
    options.encoder_bits = c.bits, options.seed = c.seed;
    options.torque_noise = c.noise_percent / 100 * kRated;
    const servoid::CorrectedInertia out = sweep(system(2), options).corrected;
    const double error = (out.inertia.value / kInertia2 - 1) * 100;
    figure(fmt::format("system 2, error of inertia_corrected, {} bit, noise {} % of rated, seed {}",
                       c.bits, c.noise_percent, c.seed),
           fmt::format("{:+.3f} ± {:.3f} %", error, 100 * out.inertia.std / kInertia2),
           "within ±1.5, paper ±20");
    EXPECT_LE(std::abs(error), 1.5);
    if (!out.antiresonance_Hz) return; // the noise hides the bias: nothing is claimed
    const Estimate& f = *out.antiresonance_Hz;
    figure("  antiresonance that the bias implies",
           fmt::format("{:.4g} ± {:.2g} Hz", f.value, f.std), "402.3 within 3 std in 1/f²");
    // In 1/f², where the fit is linear and its error symmetric.
    const double a = 1 / (f.value * f.value), std = 2 * a * f.std / f.value;
    EXPECT_LE(std::abs(a - 1 / (kAntiresonance_Hz * kAntiresonance_Hz)), 3 * std);
}

std::vector<Conditions> conditions() {
    std::vector<Conditions> out;
    for (double bits : {15.0, 17.0, 20.0})
        for (double noise : {0.0, 0.2, 0.5})
            for (unsigned long seed : {1UL, 2UL, 3UL})
                if (noise > 0 || seed == 1) out.push_back({bits, noise, seed});
    return out;
}

INSTANTIATE_TEST_SUITE_P(Sweeps, CorrectedInertiaOf, testing::ValuesIn(conditions()),
                         [](const testing::TestParamInfo<Conditions>& test) {
                             const Conditions& c = test.param;
                             return fmt::format("{}bit_{}permille_Seed{}", c.bits,
                                                10 * c.noise_percent, c.seed);
                         });

} // namespace
