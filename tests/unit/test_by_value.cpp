// Residuals that are known functions of velocity, position, acceleration and torque.
#include "compare/by_value.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

#include <map>

using namespace servoid;

namespace {

using Law = std::function<double(const PreparedMotion&, Eigen::Index)>;
using Groups = std::map<std::string, std::vector<Regime>>;

struct Scene {
    Capture capture =
        sampled([](const Kinematics& k, double) { return 0.01 * k.acceleration; }, 12);
    PreparedMotion motion = prepare_motion(capture, {40.0, {}});

    Groups with(const Law& law) const {
        Eigen::VectorXd r(motion.torque.size());
        for (Eigen::Index k = 0; k < r.size(); ++k)
            r[k] = law(motion, k);
        Groups out;
        for (const Regime& one : where_by_value({{motion, r, motion.torque}}))
            out[one.group].push_back(one);
        return out;
    }
};

double sign(double x) { return x > 0 ? 1 : -1; }

TEST(ByValue, SharesOfEachGroupAddUpTo1) {
    const Scene s;
    const Groups all = s.with([](const PreparedMotion& m, Eigen::Index k) {
        return std::sin(0.1 * double(k)) + m.position[k];
    });
    for (const auto& [group, bins] : all) {
        double residual = 0, samples = 0;
        for (const Regime& bin : bins) {
            residual += bin.residual_share, samples += bin.sample_share;
            EXPECT_GE(bin.sample_share, 0.005) << bin.regime;
        }
        EXPECT_NEAR(residual, 1, 1e-9) << group;
        EXPECT_NEAR(samples, 1, 1e-9) << group;
    }
    EXPECT_EQ(all.at("velocity").size(), 6u);
    EXPECT_EQ(all.at("position").size(), 8u);
    EXPECT_EQ(all.at("acceleration").size(), 6u);
    EXPECT_EQ(all.at("torque").size(), 6u);
}

// Coulomb friction: the sign of the velocity, and flat in its size.
TEST(ByValue, FlatInSpeedAndOfItsSign) {
    const Scene s;
    const Groups all =
        s.with([](const PreparedMotion& m, Eigen::Index k) { return 0.3 * sign(m.velocity[k]); });
    for (const Regime& bin : all.at("velocity")) {
        if (bin.from < -1e-9 && bin.to > 1e-9) continue;
        EXPECT_NEAR(bin.mean_residual, 0.3 * sign(bin.from + bin.to), 1e-12) << bin.regime;
        EXPECT_NEAR(bin.residual_share, bin.sample_share, 1e-12);
    }
    for (const Regime& bin : all.at("position"))
        EXPECT_LT(std::abs(bin.mean_residual), 0.25) << bin.regime;
}

// A straight line: the mean of a bin is the mean of the value in it.
TEST(ByValue, StraightInEachValue) {
    const Scene s;
    const std::map<std::string, Law> laws = {
        {"velocity", [](const PreparedMotion& m, Eigen::Index k) { return m.velocity[k]; }},
        {"position", [](const PreparedMotion& m, Eigen::Index k) { return m.position[k]; }},
        {"acceleration", [](const PreparedMotion& m, Eigen::Index k) { return m.acceleration[k]; }},
        {"torque", [](const PreparedMotion& m, Eigen::Index k) { return m.torque[k]; }}};
    for (const auto& [group, law] : laws) {
        const std::vector<Regime> bins = s.with(law).at(group);
        for (const Regime& bin : bins) {
            EXPECT_GE(bin.mean_residual, bin.from) << bin.regime;
            EXPECT_LE(bin.mean_residual, bin.to) << bin.regime;
        }
        const double width = bins[0].to - bins[0].from;
        for (size_t i = 0; i < bins.size(); ++i)
            EXPECT_NEAR(bins[i].from, bins[0].from + double(i) * width, 1e-9 * width) << group;
    }
}

TEST(ByValue, SparseBinsAreJoined) {
    Scene s;
    s.motion.velocity[7] *= 20; // alone at one end
    const Groups all = s.with([](const PreparedMotion&, Eigen::Index) { return 1.0; });
    const std::vector<Regime>& bins = all.at("velocity");
    EXPECT_LT(bins.size(), 6u);
    double samples = 0;
    for (const Regime& bin : bins) {
        EXPECT_GE(bin.sample_share, 0.005) << bin.regime;
        samples += bin.sample_share;
    }
    EXPECT_NEAR(samples, 1, 1e-9);
    EXPECT_NEAR(bins.front().from, s.motion.velocity.minCoeff(), 1e-9);
    EXPECT_NEAR(bins.back().to, s.motion.velocity.maxCoeff(), 1e-9);
}

TEST(ByValue, CapturesShareTheirBins) {
    const Scene s;
    PreparedMotion faster = s.motion;
    faster.velocity *= 2;
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(s.motion.torque.size());
    const auto all =
        where_by_value({{s.motion, one, s.motion.torque}, {faster, -one, s.motion.torque}});
    std::vector<Regime> bins;
    for (const Regime& r : all)
        if (r.group == "velocity") bins.push_back(r);
    ASSERT_EQ(bins.size(), 6u);
    EXPECT_DOUBLE_EQ(bins.front().from, faster.velocity.minCoeff());
    EXPECT_NEAR(bins.back().to, faster.velocity.maxCoeff(), 1e-9);
    EXPECT_DOUBLE_EQ(bins.front().mean_residual, -1) << "only the faster one goes there";
    EXPECT_GT(bins[2].mean_residual, -1);
}

TEST(ByValue, WithoutAPositionThereIsNoSuchGroup) {
    Scene s;
    s.motion.position.resize(0);
    const Groups all = s.with([](const PreparedMotion&, Eigen::Index) { return 1.0; });
    EXPECT_FALSE(all.contains("position"));
    EXPECT_TRUE(all.contains("velocity"));
}

TEST(ByValue, NamesCarryEdgesAndUnits) {
    Scene s;
    const auto first = [&](const std::string& group) {
        return s.with([](const PreparedMotion&, Eigen::Index) { return 1.0; }).at(group)[0].regime;
    };
    // Velocity: ±(2π + 2.4π) = ±13.823 rad/s; a sixth of 27.646 is 4.608.
    EXPECT_EQ(first("velocity"), "velocity -13.8…-9.2 rad/s");
    EXPECT_TRUE(first("torque").ends_with(" N·m")) << first("torque");
    s.motion.motion.kind = Motion::linear;
    EXPECT_EQ(first("velocity"), "velocity -13.8…-9.2 m/s");
    EXPECT_TRUE(first("acceleration").ends_with(" m/s²")) << first("acceleration");
    EXPECT_TRUE(first("torque").ends_with(" N")) << first("torque");
    s.capture.torque_in_ampere = true;
    EXPECT_TRUE(first("torque").ends_with(" A")) << first("torque");
}

} // namespace
