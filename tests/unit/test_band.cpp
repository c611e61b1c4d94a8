// The band reaches what comes back with every period, however far above the move.
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

using namespace servoid;

namespace {

constexpr const char* kSlowSine = "sine:frequency_Hz=1,amplitude=6,periods=4,torque_noise=1e-4";
constexpr double kTopSpeed = 2 * std::numbers::pi * 6; // rad/s

// The torque answers what disturbs the axis up to some 140 Hz. No Coulomb friction: its edges
// repeat as well.
Model stiff_drive(const std::string& more = "") {
    Model out = bare_drive("[effects.viscous]\ncoefficient = 9.6e-4\n" + more);
    out.controller->speed_gain = 5e-2;
    return out;
}

const PreparedMotion& prepared(const Recorded& r, const std::string& of) {
    const PreparedMotion& m = r.motions[0];
    std::printf("figure: band of %s = %.3g Hz\n", of.c_str(), m.band_Hz);
    return m;
}

} // namespace

TEST(Band, ReachesCoggingFarAboveASlowSine) {
    for (const int order : {6, 12, 24}) {
        const Recorded r(stiff_drive("[effects.cogging]\namplitude = 1e-2\norder = " +
                                     std::to_string(order) + "\nphase = 0.5\n"),
                         kSlowSine);
        const PreparedMotion& m = prepared(r, "cogging of order " + std::to_string(order));
        const double fastest_Hz = order * kTopSpeed / (2 * std::numbers::pi);
        EXPECT_GT(m.band_Hz, 0.95 * fastest_Hz) << order; // two digits, rounded down
        EXPECT_LT(m.band_Hz, 2.5 * fastest_Hz) << order;
        EXPECT_EQ(m.band_limited_by, BandLimit::repetition) << order;
    }
}

// As much of what does not come back, and the counts of the encoder, widen nothing: four times the
// sine, or what so short a record allows.
TEST(Band, NoiseDoesNotWidenIt) {
    const Recorded r(stiff_drive(), "sine:frequency_Hz=1,amplitude=6,periods=4,torque_noise=1e-2");
    EXPECT_LT(prepared(r, "noise").band_Hz, 10);
}
