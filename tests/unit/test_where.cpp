// Residuals put in one place on purpose: they must be found there.
#include "compare/where.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

using namespace servoid;

namespace {

struct Scene {
    Capture capture =
        sampled([](const Kinematics& k, double) { return 0.01 * k.acceleration; }, 12);
    PreparedMotion motion = prepare_motion(capture, {40.0, {}});
    double top_speed = motion.velocity.cwiseAbs().maxCoeff();

    std::vector<Regime> with(const std::function<double(Eigen::Index)>& residual) const {
        Eigen::VectorXd r(motion.torque.size());
        for (Eigen::Index k = 0; k < r.size(); ++k)
            r[k] = residual(k);
        return where_it_fails(motion, r);
    }
};

const Regime& named(const std::vector<Regime>& all, const std::string& start) {
    for (const Regime& r : all)
        if (r.regime.starts_with(start)) return r;
    static const Regime none;
    ADD_FAILURE() << "no regime " << start;
    return none;
}

double noise() {
    static std::mt19937_64 random(3);
    static std::normal_distribution<double> gauss(0, 1);
    return gauss(random);
}

TEST(Where, SharesOfEachGroupAddUpTo1) {
    const Scene s;
    std::map<std::string, double> residual, samples;
    for (const Regime& r : s.with([](Eigen::Index) { return noise(); }))
        residual[r.group] += r.residual_share, samples[r.group] += r.sample_share;
    for (const char* group : {"regime", "direction", "frequency", "time"}) {
        EXPECT_NEAR(residual[group], 1, 1e-9) << group;
        EXPECT_NEAR(samples[group], 1, 1e-9) << group;
    }
}

TEST(Where, NoiseEverywhereIsAsItsSamples) {
    const Scene s;
    for (const Regime& r : s.with([](Eigen::Index) { return noise(); })) {
        if (r.group == "frequency" || r.group == "position order") continue;
        EXPECT_NEAR(r.residual_share, r.sample_share, 0.06) << r.regime;
    }
}

TEST(Where, Reversal) {
    const Scene s;
    const auto all = s.with([&](Eigen::Index k) {
        return std::abs(s.motion.velocity[k]) < 0.04 * s.top_speed ? 1.0 : 0.01;
    });
    EXPECT_EQ(all.front().regime, "reversal");
    EXPECT_GT(all.front().residual_share, 0.95);
    EXPECT_LT(all.front().sample_share, 0.15);
}

TEST(Where, Direction) {
    const Scene s;
    const auto all =
        s.with([&](Eigen::Index k) { return s.motion.velocity[k] < 0 ? noise() : 0.01; });
    EXPECT_GT(named(all, "reverse").residual_share, 0.98);
    EXPECT_LT(named(all, "forward").residual_share, 0.02);
    EXPECT_NEAR(named(all, "forward").sample_share, 0.5, 0.05);
}

// Power changes with the speed by speeding up or braking: a·v > 0 or < 0.
TEST(Where, AccelerationAndBraking) {
    const Scene s;
    const auto power = [&](Eigen::Index k) {
        return s.motion.velocity[k] * s.motion.acceleration[k];
    };
    const double top = s.motion.acceleration.cwiseAbs().maxCoeff();
    const auto strong = [&](Eigen::Index k) {
        return std::abs(s.motion.acceleration[k]) > 0.3 * top &&
               std::abs(s.motion.velocity[k]) > 0.06 * s.top_speed;
    };
    EXPECT_EQ(s.with([&](Eigen::Index k) { return strong(k) && power(k) > 0 ? 1.0 : 0.0; })
                  .front()
                  .regime,
              "acceleration");
    EXPECT_EQ(s.with([&](Eigen::Index k) { return strong(k) && power(k) < 0 ? 1.0 : 0.0; })
                  .front()
                  .regime,
              "braking");
}

TEST(Where, CruiseOfTheHighestSpeeds) {
    const Scene s;
    const double top = s.motion.acceleration.cwiseAbs().maxCoeff();
    const auto all = s.with([&](Eigen::Index k) {
        const bool cruise = std::abs(s.motion.acceleration[k]) < 0.1 * top;
        return cruise && std::abs(s.motion.velocity[k]) > 0.7 * s.top_speed ? 1.0 : 0.0;
    });
    const Regime& found = all.front();
    EXPECT_TRUE(found.regime.starts_with("cruise")) << found.regime;
    EXPECT_TRUE(found.regime.ends_with("rad/s")) << found.regime;
    EXPECT_GT(found.residual_share, 0.99);
}

TEST(Where, FrequencyBand) {
    const Scene s;
    const auto sine = [&](double hertz) {
        return s.with([&, hertz](Eigen::Index k) {
            return std::sin(2 * std::numbers::pi * hertz * s.motion.grid.at(k));
        });
    };
    EXPECT_GT(named(sine(1), "frequency 0…2 Hz").residual_share, 0.97);
    EXPECT_GT(named(sine(10), "frequency 6…16 Hz").residual_share, 0.97);
    EXPECT_GT(named(sine(30), "frequency 16…40 Hz").residual_share, 0.97);
}

TEST(Where, PositionOrder) {
    const Scene s;
    for (const double order : {5.0, 8.0}) {
        const auto all =
            s.with([&](Eigen::Index k) { return std::sin(order * s.motion.position[k] + 0.4); });
        const Regime& found = named(all, "order");
        EXPECT_NEAR(std::stod(found.regime.substr(6)), order, 0.1) << found.regime;
        EXPECT_GT(found.residual_share, 0.95);
        EXPECT_LT(found.sample_share, 0.01);
    }
}

TEST(Where, TimePart) {
    const Scene s;
    const Grid& grid = s.motion.grid;
    const auto all = s.with([&](Eigen::Index k) { return k * 6 / grid.count == 4 ? 1.0 : 0.01; });
    const double part = double(grid.count) * grid.step_s / 6;
    int parts = 0;
    for (const Regime& r : all) {
        if (r.group != "time") continue;
        ++parts;
        if (r.residual_share < 0.5) continue;
        EXPECT_GT(r.residual_share, 0.99);
        EXPECT_NEAR(std::stod(r.regime.substr(5)), grid.start_s + 4 * part, 0.01) << r.regime;
    }
    EXPECT_EQ(parts, 6);
}

TEST(Where, LinearAxisSpeaksOfMetres) {
    Scene s;
    s.capture.linear = true;
    const auto all = s.with([&](Eigen::Index k) { return std::sin(5 * s.motion.position[k]); });
    EXPECT_NE(named(all, "order").regime.find("per m"), std::string::npos);
    EXPECT_NE(named(all, "cruise").regime.find("m/s"), std::string::npos);
}

} // namespace
