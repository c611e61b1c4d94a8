// The torque view's least squares on torques made from known coefficients.
#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <random>

using namespace servoid;

namespace {

constexpr double kClose = 2e-5; // what the smoothing of the motion leaves in its pass band

// Start values that are all wrong.
Model believed() { return rigid_axis(1, 1, 1); }

FitResult fit_one(const Model& model, const Capture& capture, double band_Hz = 40) {
    return fit(model, prepare_all({&capture, 1}, {band_Hz, {}}));
}

TEST(Regression, KnownCoefficientsComeBack) {
    const Capture c = sampled([](const Kinematics& k, double) { return rigid_torque(k); }, 6);
    const FitResult f = fit_one(believed(), c);
    EXPECT_NEAR(f.values[0], kInertia, kClose * kInertia);
    EXPECT_NEAR(f.values[1], kViscous, kClose * kViscous);
    EXPECT_NEAR(f.values[2], kOffset, kClose);
    EXPECT_LT(f.torque_error, kClose);
    EXPECT_TRUE(f.at_bound.empty());
    EXPECT_EQ(f.model.inertia, f.values[0]);
    EXPECT_EQ(f.model.effects[0].at("coefficient"), f.values[1]);
    EXPECT_EQ(coefficient_name(f.model, f.coefficients[1]), "viscous.coefficient");
}

TEST(Regression, SeveralCapturesWithDifferentSampleTimes) {
    const auto law = [](const Kinematics& k, double) { return rigid_torque(k); };
    const std::vector<Capture> captures = {sampled(law, 4), sampled(law, 5, 0.5e-3)};
    const FitResult f = fit(believed(), prepare_all(captures, {40.0, {}}));
    EXPECT_NEAR(f.values[0], kInertia, kClose * kInertia);
    EXPECT_NEAR(f.values[1], kViscous, kClose * kViscous);
}

// A linear axis whose model says the length of a cycle.
TEST(Regression, PeriodInMetres) {
    constexpr double kPeriod_m = 0.35, kAmplitude = 0.2;
    Capture c = sampled(
        [](const Kinematics& k, double) {
            return rigid_torque(k) +
                   kAmplitude * std::sin(2 * std::numbers::pi / kPeriod_m * k.position + 0.4);
        },
        12);
    c.linear = true;
    Model model = believed();
    model.motion = Motion::linear;
    model.effects.push_back(
        term("cogging", {{"amplitude", 0.1}, {"period", 1.02 * kPeriod_m}, {"phase", 0}}));
    const FitResult f = fit_one(model, c, 100);
    const EffectTerm& cogging = f.model.effects.back();
    EXPECT_NEAR(cogging.at("period"), kPeriod_m, 1e-4 * kPeriod_m);
    EXPECT_NEAR(cogging.at("amplitude"), kAmplitude, 1e-3 * kAmplitude);
    EXPECT_NEAR(cogging.at("phase"), 0.4, 1e-2);
    EXPECT_FALSE(cogging.parameters.contains("order"));
    const auto named = std::find_if(f.parameters.begin(), f.parameters.end(),
                                    [](const auto& p) { return p.name == "cogging.period"; });
    ASSERT_NE(named, f.parameters.end());
    EXPECT_EQ(unit_of(named->quantity, Motion::linear), "m");
    EXPECT_GT(named->estimate.std, 0);
}

TEST(Regression, FixedParametersStay) {
    const Capture c = sampled([](const Kinematics& k, double) { return rigid_torque(k); }, 6);
    Model model = believed();
    model.inertia = 0.02, model.inertia_fixed = true;
    model.effects[0].parameters["coefficient"] = 0.05;
    model.effects[0].fixed = {"coefficient"};
    const FitResult f = fit_one(model, c);
    EXPECT_EQ(f.values[0], 0.02);
    EXPECT_EQ(f.values[1], 0.05);
    EXPECT_EQ(f.std[0], 0);
    EXPECT_EQ(f.std[1], 0);
    EXPECT_NEAR(f.values[2], kOffset, 0.02);
    EXPECT_GT(f.torque_error, 0.1);
}

TEST(Regression, EverythingFixedIsOnlyCompared) {
    const Capture c = sampled([](const Kinematics& k, double) { return rigid_torque(k); }, 6);
    Model model = believed();
    model.inertia = kInertia, model.inertia_fixed = true;
    model.effects = {};
    const FitResult f = fit_one(model, c);
    EXPECT_EQ(f.values[0], kInertia);
    EXPECT_GT(f.torque_error, 0);
}

// A negative friction is no answer: it is held at zero, and the rest is fitted without it.
TEST(Regression, NegativeFrictionStopsAtItsBound) {
    const Capture c =
        sampled([](const Kinematics& k,
                   double) { return kInertia * k.acceleration - 0.01 * k.velocity + kOffset; },
                6);
    const FitResult f = fit_one(believed(), c);
    EXPECT_EQ(f.at_bound, std::vector<std::string>{"viscous.coefficient"});
    EXPECT_EQ(f.values[1], 0);
    EXPECT_NEAR(f.values[0], kInertia, 0.01 * kInertia);
    EXPECT_NEAR(f.values[2], kOffset, 0.01);
}

// A constant torque may lie either way.
TEST(Regression, OffsetHasNoBound) {
    const Capture c =
        sampled([](const Kinematics& k, double) { return kInertia * k.acceleration - 2; }, 6);
    const FitResult f = fit_one(believed(), c);
    EXPECT_NEAR(f.values[2], -2, 1e-4);
}

TEST(Regression, EqualColumnsAreRefused) {
    const Capture c = sampled([](const Kinematics& k, double) { return rigid_torque(k); }, 6);
    Model model = believed();
    model.effects.push_back(term("viscous", {{"coefficient", 1}}));
    EXPECT_THROW(fit_one(model, c), Refusal);
}

TEST(Regression, ReversedSignIsRefused) {
    const Capture c = sampled([](const Kinematics& k, double) { return -rigid_torque(k); }, 6);
    Model model;
    model.inertia = 1;
    EXPECT_THROW(fit_one(model, c), Refusal);
}

TEST(Regression, ModelTorqueIsColumnsTimesValues) {
    const Capture c = sampled([](const Kinematics& k, double) { return rigid_torque(k); }, 6);
    const FitResult f = fit_one(believed(), c);
    const std::vector<PreparedMotion> motions = prepare_all({&c, 1}, {40.0, {}});
    const Assembly r = Assembler(motions).assemble(f.model);
    const Eigen::VectorXd torque = model_torque(f.model, motions.front());
    EXPECT_EQ(r.columns.rows(), std::count(motions[0].used.begin(), motions[0].used.end(), true));
    EXPECT_LT((r.columns * f.values - r.torque).norm(), kClose * r.torque.norm());
    EXPECT_LT((torque - motions[0].torque).norm(), kClose * torque.norm());
}

// Noise that hangs together over many samples, AR(1): what plain least squares takes for many
// independent errors. The stated deviation must be the one that is seen over many records, as long
// as the errors forget within an eighth of a block (20 s make 24 blocks; 0.975 forgets in 0.16 s).
struct Spread {
    Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = sum, stated = sum;
    int records = 0;
    void add(const FitResult& f) {
        sum += f.values.array(), squares += f.values.array().square(), stated += f.std.array();
        ++records;
    }
    Eigen::Array3d ratio() const {
        const Eigen::Array3d observed = ((squares - sum * sum / records) / (records - 1)).sqrt();
        return stated / records / observed;
    }
};

Capture with_errors(double memory, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss(0, 0.05 * std::sqrt(1 - memory * memory));
    double error = 0;
    return sampled(
        [&](const Kinematics& k, double) {
            error = memory * error + gauss(random);
            return rigid_torque(k) + error;
        },
        20, 4e-3);
}

class BlockRobust : public testing::TestWithParam<double> {};

TEST_P(BlockRobust, StatedDeviationIsTheObservedOne) {
    Spread spread;
    for (unsigned seed = 1; seed <= 200; ++seed)
        spread.add(fit_one(believed(), with_errors(GetParam(), seed), 20));
    for (const int i : {0, 1, 2}) {
        fmt::print("figure: errors with memory {} a sample, coefficient {}, stated over observed "
                   "std = {:.3f} (asked: 0.8 to 1.2)\n",
                   GetParam(), i, spread.ratio()[i]);
        EXPECT_NEAR(spread.ratio()[i], 1, 0.2) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Memory, BlockRobust, testing::Values(0.0, 0.9, 0.975),
                         [](const testing::TestParamInfo<double>& test) {
                             return std::to_string(int(std::lround(1000 * test.param))) +
                                    "Permille";
                         });

} // namespace
