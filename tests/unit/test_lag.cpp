// Delays that are put in: into torques from closed forms, and into the simulated drive.
#include "common/error.hpp"
#include "compare/lag.hpp"
#include "unit/drive_helpers.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

using namespace servoid;

namespace {

Model believed() { return rigid_axis(kInertia, kViscous, kOffset); }

// Recorded so much before it acts.
Capture early_by(double lag_s, double noise = 0, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss(0, 1);
    return sampled(
        [&](const Kinematics&, double t) {
            return rigid_torque(two_sines(t + lag_s)) + noise * gauss(random);
        },
        12);
}

std::optional<Estimate> lag_in(const Model& model, const Capture& capture, double band_Hz = 20) {
    const std::vector<PreparedMotion> motions = {prepare_motion(capture, {band_Hz, {}})};
    return lag_of_torque(model, motions);
}

TEST(Lag, ClosedForm) {
    for (const double truth : {0.0, 0.4e-3, -0.4e-3, 2.5e-3, 20e-3}) {
        const auto lag = lag_in(believed(), early_by(truth));
        ASSERT_TRUE(lag) << truth;
        EXPECT_NEAR(lag->value, truth, 3e-6);
    }
}

TEST(Lag, WrongNumbersAreNoDelay) {
    Model model = believed();
    model.inertia *= 3;
    model.effects[0].parameters["coefficient"] = 0;
    const auto lag = lag_in(model, early_by(1e-3));
    ASSERT_TRUE(lag);
    EXPECT_NEAR(lag->value, 1e-3, 3e-6);
    model.effects.clear(); // nor is friction that the model lacks
    EXPECT_NEAR(lag_in(model, early_by(1e-3))->value, 1e-3, 3e-6);
}

// As the standard deviation says: no more than one of 40 beyond three of them, and not far too
// many.
TEST(Lag, StandardDeviationOfNoise) {
    constexpr int kRuns = 40;
    double sum = 0;
    int beyond = 0;
    for (unsigned seed = 1; seed <= kRuns; ++seed) {
        const auto lag = lag_in(believed(), early_by(1e-3, 0.05, seed));
        ASSERT_TRUE(lag);
        const double score = (lag->value - 1e-3) / lag->std;
        sum += score * score / kRuns, beyond += std::abs(score) > 3;
    }
    std::printf("figure: lag, rms of (value - truth)/std over noises %.2f\n", std::sqrt(sum));
    EXPECT_LE(beyond, 1);
    EXPECT_LT(sum, 1.5 * 1.5);
    EXPECT_GT(sum, 0.4 * 0.4);
}

// A held reference acts half a sample later, and that is no lag.
TEST(Lag, HalfASampleOfHoldIsKnown) {
    Capture c = early_by(0.5e-3); // its step is 1 ms
    EXPECT_NEAR(lag_in(believed(), c)->value, 0.5e-3, 3e-6);
    c.ref_held = true;
    EXPECT_NEAR(lag_in(believed(), c)->value, 0, 3e-6);
    c.torque_delay_s = 1e-3;
    EXPECT_NEAR(lag_in(believed(), c)->value, -1e-3, 3e-6);
}

TEST(Lag, DeadTimeOfTheModelIsKnown) {
    Model model = believed();
    model.effects.push_back(term("dead_time", {{"delay", 0.7e-3}}));
    EXPECT_NEAR(lag_in(model, early_by(1e-3))->value, 0.3e-3, 3e-6);
}

TEST(Lag, SeveralCaptures) {
    const std::vector<Capture> captures = {early_by(1e-3), early_by(1e-3)};
    std::vector<PreparedMotion> motions;
    for (const Capture& c : captures)
        motions.push_back(prepare_motion(c, {20.0, {}}));
    EXPECT_NEAR(lag_of_torque(believed(), motions)->value, 1e-3, 3e-6);
}

// On one sine a delay is viscous friction.
TEST(Lag, ASineDoesNotTell) {
    Capture c = early_by(0);
    for (size_t i = 0; i < c.rows(); ++i) {
        const double w = 10, t = c.time_s[i];
        c.position[i] = std::sin(w * t);
        c.torque_ref[i] = -kInertia * w * w * std::sin(w * (t + 1e-3));
    }
    Model model = believed();
    model.effects.erase(model.effects.begin());
    EXPECT_FALSE(lag_in(model, c));
}

TEST(Lag, BeyondTheSearchThereIsNone) {
    EXPECT_TRUE(lag_in(believed(), early_by(0.045)));
    EXPECT_FALSE(lag_in(believed(), early_by(0.055)));
}

std::optional<Estimate> simulated_lag(const Model& truth, const Model& model,
                                      const std::string& move) {
    const Recorded r(truth, move);
    return lag_of_torque(model, r.motions);
}

const char* const kMoves[] = {
    "trapezoid:cycles=3", "trapezoid:cycles=3,torque_noise=2e-3", "staircase:cycles=3",
    "multisine:to_Hz=100,amplitude=0.5,torque_noise=1e-3",
    "multisine:from_Hz=2,to_Hz=80,step_Hz=2,amplitude=0.5,periods=6,torque_noise=3e-3"};

// Simulated drives: Coulomb friction that sticks, an encoder that counts, noise that goes round.
TEST(Lag, DeadTimeOfTheDrive) {
    const double truth = 0.4e-3;
    for (const char* move : kMoves) {
        const auto lag =
            simulated_lag(drive("[effects.dead_time]\ndelay = 0.4e-3\n"), drive(), move);
        ASSERT_TRUE(lag) << move;
        std::printf("figure: lag, 400 us in the drive: %.1f +- %.1f us, %s\n", 1e6 * lag->value,
                    1e6 * lag->std, move);
        EXPECT_NEAR(lag->value, truth, std::max(3 * lag->std, 0.05 * truth)) << move;
        EXPECT_LT(lag->std, 0.2 * truth) << move;
    }
}

TEST(Lag, CompleteModelHasNone) {
    for (const char* move : kMoves) {
        const auto lag = simulated_lag(drive(), drive(), move);
        ASSERT_TRUE(lag) << move;
        EXPECT_LT(std::abs(lag->value), 3 * lag->std) << move;
    }
}

TEST(Lag, MissingCoulombFrictionIsNone) {
    Model without = drive();
    without.effects.pop_back();
    for (const char* move : kMoves) {
        const auto lag = simulated_lag(drive(), without, move);
        ASSERT_TRUE(lag) << move;
        EXPECT_LT(std::abs(lag->value), 3 * lag->std) << move;
    }
}

} // namespace
