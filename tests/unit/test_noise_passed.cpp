// What takes noise from a recorded torque, or information, has no merit by that.
#include "compare/assembly.hpp"
#include "diagnose/diagnose.hpp"
#include "effects/catalogue.hpp"
#include "unit/drive_helpers.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr unsigned kSeed = 20261122;
constexpr double kBand_Hz = 60;

// Every row has noise of its own, as a measured current has.
Capture measured_with_noise(double noise_Nm) {
    std::mt19937 random(kSeed);
    std::normal_distribution<double> gauss(0, noise_Nm);
    Capture c =
        sampled([&](const Kinematics& k, double) { return rigid_torque(k) + gauss(random); }, 10);
    c.torque = std::move(c.torque_ref);
    c.torque_ref.clear();
    return c;
}

double probability_of(const Diagnosis& d, const std::string& effect) {
    for (const Candidate& c : d.candidates)
        if (c.effect == effect) return c.probability;
    return NAN;
}

double inertia_of(const Diagnosis& d) { return d.candidates[0].fit.model.inertia; }

} // namespace

TEST(NoisePassed, OfALagIsTheGeometricMeanOfItsGain) {
    const std::vector<Capture> captures = {measured_with_noise(0)};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {kBand_Hz, {}});
    for (const double tau : {1e-4, 1e-3, 1e-2, 0.1}) {
        Model model = rigid_axis(1, 1, 1);
        model.effects.push_back(term("torque_lag", {{"time_constant", tau}}));
        double sum = 0;
        constexpr int n = 20000;
        for (int i = 0; i < n; ++i)
            sum -=
                std::log1p(std::pow(2 * std::numbers::pi * kBand_Hz * (i + 0.5) / n * tau, 2)) / 2;
        EXPECT_NEAR(noise_passed(model, motions), std::exp(sum / n), 1e-6) << tau;
    }
    EXPECT_EQ(noise_passed(rigid_axis(1, 1, 1), motions), 1);
}

TEST(NoisePassed, ATorqueReferenceHasNone) {
    Capture c = measured_with_noise(0);
    c.torque_ref = std::move(c.torque);
    c.torque.clear();
    const std::vector<Capture> captures = {std::move(c)};
    Model model = rigid_axis(1, 1, 1);
    model.effects.push_back(term("torque_lag", {{"time_constant", 1e-2}}));
    EXPECT_EQ(noise_passed(model, prepare_all(captures, {kBand_Hz, {}})), 1);
}

// A lag smooths it, which leaves less.
TEST(NoisePassed, NoiseOfAMeasuredTorqueIsNoLag) {
    const std::vector<Capture> captures = {measured_with_noise(1)};
    const Diagnosis d = diagnose(rigid_axis(kInertia, kViscous, kOffset),
                                 prepare_all(captures, {kBand_Hz, {}}), {{}, false});
    std::printf("figure: %s, torque error %.3g, torque_lag p %.3g\n", verdict_name(d.verdict),
                d.error_before, probability_of(d, "torque_lag"));
    EXPECT_GT(d.error_before, 0.1);
    EXPECT_EQ(d.verdict, Verdict::adequate) << d.advice;
    EXPECT_LT(probability_of(d, "torque_lag"), 0.5);
}

// A limit at the Coulomb torque, and no inertia: what arrives is sgn v, and all explained.
TEST(NoisePassed, AStiffeningSpringIsNoLimit) {
    const std::string law =
        "[effects.custom.x]\nlaw = \"k*theta^3\"\n[effects.custom.x.parameters]\nk = ";
    for (const auto& [k, move] :
         {std::pair{"1e-3", "trapezoid:stroke=2,velocity=8,acceleration=100,cycles=3,"
                            "torque_noise=2e-3"},
          {"4e-3", "sine:frequency_Hz=3,amplitude=2,periods=4,torque_noise=2e-3"}}) {
        const Recorded r(drive(law + k + "\n"), move, 1);
        const Diagnosis d = diagnose(drive(), r.motions);
        std::printf("figure: k %s: %s, %s, inertia %.3g kg·m²\n", k, verdict_name(d.verdict),
                    d.candidates[0].effect.c_str(), inertia_of(d));
        EXPECT_NE(d.verdict, Verdict::missing) << d.advice;
        EXPECT_NE(d.candidates[0].effect, "torque_saturation");
    }
}

// Half of what is asked arrives, and viscous friction is missing as well.
TEST(NoisePassed, ALimitThatIsMetAllTheTimeKeepsTheInertia) {
    const Recorded r(
        drive("[effects.torque_saturation]\nlimit = 0.08\n"),
        "multisine:from_Hz=5,to_Hz=50,step_Hz=5,amplitude=1,periods=4,torque_noise=1e-3");
    Model believed = drive();
    believed.effects.erase(believed.effects.begin()); // viscous
    const Diagnosis d = diagnose(believed, r.motions, {{}, false});
    const Candidate& first = d.candidates[0];
    EXPECT_EQ(first.effect, "torque_saturation");
    const double limit = first.fit.model.find("torque_saturation")->at("limit");
    std::printf("figure: limit %.4f of 0.08 N·m, inertia %.3g of 5.56e-5 kg·m²\n", limit,
                inertia_of(d));
    EXPECT_NEAR(limit / 0.08, 1, 0.2);
    EXPECT_NEAR(inertia_of(d) / 5.56e-5, 1, 0.2);
}
