#include "report/sparkline.hpp"

#include <gtest/gtest.h>

using namespace servoid;

namespace {

TEST(Sparkline, ZeroIsInTheMiddleAndTheEndsAreClipped) {
    EXPECT_EQ(sparkline({-9, -1, -0.5, 0, 0.5, 1, 9}, 1, false), "__.-'\"\"");
    EXPECT_EQ(sparkline({-9, -1, 0, 1, 9}, 1, true), "▁▁▄▇▇");
}

TEST(Sparkline, NothingToSee) {
    EXPECT_EQ(sparkline({0, 0}, 0, false), "--");
    EXPECT_EQ(sparkline({}, 1, false), "");
}

} // namespace
