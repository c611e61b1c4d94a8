// The pictures of `servoid effects`: each shows what the effect's signature says.
#include "effects/catalogue.hpp"
#include "report/signature.hpp"
#include "report/text_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace servoid;

namespace {

Signature signature(const std::string& name) { return signature_of(*find_effect(name)); }

// Zero included, as in the picture.
double range_of(const std::vector<double>& v) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    return std::max(0.0, *high) - std::min(0.0, *low);
}

// The share of points, among those of x, for which y is what a law says, within `off`.
template <class Law, class Which>
double share_on(const Signature& s, double off, Which which, Law law) {
    double on = 0, all = 0;
    for (size_t i = 0; i < s.x.size(); ++i) {
        if (!which(s.x[i])) continue;
        all += 1, on += std::abs(s.y[i] - law(s.x[i])) < off ? 1 : 0;
    }
    return all > 0 ? on / all : 0;
}
bool any(double) { return true; }

TEST(Signature, EveryEffectHasOneThatIsSeen) {
    for (const Effect* effect : catalogue()) {
        if (effect->info().written) continue; // a law that nobody has written yet shows nothing
        const std::string name = effect->info().name;
        SCOPED_TRACE(name);
        const Signature s = signature_of(*effect);
        ASSERT_EQ(s.x.size(), s.y.size());
        EXPECT_GE(s.x.size(), 20u);
        EXPECT_TRUE(std::all_of(s.y.begin(), s.y.end(), [](double y) { return std::isfinite(y); }));
        EXPECT_FALSE(s.x_unit.empty() || s.y_unit.empty() || s.x_name.empty() || s.y_name.empty());
        if (name == "torque_gain")
            EXPECT_LT(range_of(s.y), 2 * s.smallest_range); // inertia and friction take it up
        else
            EXPECT_GT(range_of(s.y), 2 * s.smallest_range);
    }
}

TEST(Signature, FrictionAgainstVelocity) {
    EXPECT_GT(share_on(signature("viscous"), 2e-4, any, [](double v) { return 2e-4 * v; }), 0.95);
    const auto away = [](double v) { return std::abs(v) > 10; };
    EXPECT_GT(
        share_on(signature("coulomb"), 3e-4, away, [](double v) { return std::copysign(6e-3, v); }),
        0.95);
    EXPECT_GT(share_on(signature("coulomb_asymmetric"), 4e-4, away,
                       [](double v) { return v > 0 ? 8e-3 : -4e-3; }),
              0.95);
    EXPECT_GT(share_on(signature("viscous_asymmetric"), 1e-4, away,
                       [](double v) { return 0.5e-4 * std::abs(v); }),
              0.95);
    EXPECT_GT(share_on(
                  signature("stribeck"), 3e-4, [](double v) { return std::abs(v) > 15; },
                  [](double) { return 0.0; }),
              0.95);
    EXPECT_GT(range_of(signature("stribeck").y), 8e-3);
}

TEST(Signature, PositionTimeAndTorque) {
    EXPECT_GT(
        share_on(signature("gravity"), 3e-4, any, [](double x) { return 8e-3 * std::sin(x); }),
        0.95);
    EXPECT_GT(share_on(signature("spring"), 3e-4, any, [](double x) { return 3e-3 * (x - 3); }),
              0.95);
    EXPECT_GT(share_on(
                  signature("hard_stop"), 3e-4, [](double x) { return std::abs(x) < 1.8; },
                  [](double) { return 0.0; }),
              0.95);
    EXPECT_GT(share_on(
                  signature("torque_saturation"), 5e-4,
                  [](double torque) { return std::abs(torque) < 0.012; },
                  [](double) { return 0.0; }),
              0.95);
    const double w = 2 * std::acos(-1.0) * 11;
    EXPECT_GT(share_on(signature("periodic_disturbance"), 4e-4, any,
                       [w](double t) { return 5e-3 * std::sin(w * t); }),
              0.95);
}

// A delay of 1 ms: sin ωτ of the torque that the model expects.
TEST(Signature, DeadTimeAgainstFrequency) {
    const double w = 2 * std::acos(-1.0) * 1e-3;
    EXPECT_GT(
        share_on(signature("dead_time"), 1, any, [w](double f) { return 100 * std::sin(w * f); }),
        0.95);
}

// --- the plot ---------------------------------------------------------------------------------

TextPlot small(bool braille) {
    TextPlot plot;
    plot.columns = 6, plot.rows = 3, plot.braille = braille;
    plot.x_label = "x", plot.y_label = "y";
    return plot;
}

TEST(TextPlot, ARisingLineInAscii) {
    const std::vector<double> x = {0, 1, 2, 3, 4, 5}, y = {-4, -2, 0, 2, 4, 5};
    const std::vector<std::string> expected = {"y", "        5 |   .''|",
                                               "        0 |--*---|", // the line of zero
                                               "       -4 |.'    |", "           0 x  5"};
    EXPECT_EQ(draw(x, y, small(false)), expected);
}

TEST(TextPlot, BrailleDotsAreWhereThePointsAre) {
    const std::vector<std::string> lines = draw({0, 1}, {0, 1}, small(true));
    // Lower left dot 7 (U+2840), upper right dot 4 (U+2808).
    EXPECT_NE(lines[3].find("|\u2840"), std::string::npos) << lines[3];
    EXPECT_NE(lines[1].find("\u2808|"), std::string::npos) << lines[1];
}

TEST(TextPlot, NothingIsNotBlownUp) {
    TextPlot plot = small(false);
    plot.smallest_range = 1;
    const std::vector<std::string> lines = draw({0, 1, 2}, {1e-9, -1e-9, 1e-9}, plot);
    EXPECT_NE(lines[1].find("0.5"), std::string::npos) << lines[1];
    EXPECT_TRUE(draw({}, {}, plot).empty());
}

} // namespace
