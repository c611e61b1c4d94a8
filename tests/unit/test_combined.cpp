// Several frequencies, one answer: no deviation is made up.
#include "identify/identify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace servoid {

namespace {

Identification with(double inertia, double std) {
    Identification out;
    out.inertia = {inertia, std}, out.viscous = {1, 0.1};
    return out;
}

} // namespace

TEST(Combined, MeansAreWeightedWithTheirDeviations) {
    const Identification out = combined({with(1, 0.1), with(2, 0.2)});
    EXPECT_NEAR(out.inertia.value, 1.2, 1e-12); // (100 + 2 * 25) / 125
    EXPECT_NEAR(out.inertia.std, 1 / std::sqrt(125.0), 1e-12);
}

TEST(Combined, WhereOneDeviationIsUnknownSoIsTheirs) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const Identification out = combined({with(1, 0.1), with(2, unknown)});
    EXPECT_NEAR(out.inertia.value, 1.5, 1e-12);
    EXPECT_TRUE(std::isnan(out.inertia.std));
    EXPECT_NEAR(out.viscous.std, 0.1 / std::sqrt(2.0), 1e-12) << "that one is known";
}

} // namespace servoid
