// Friction that bends before it slides is late by itself: the capture is not.
#include "diagnose/sanity.hpp"
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

using namespace servoid;

namespace {

// The bristles are the friction: nothing slides before stiffness times way exceeds the torque.
Model with_bristles(const std::string& torque, const std::string& stiffness) {
    return bare_drive("[effects.viscous]\ncoefficient = 9.6e-4\n[effects.presliding]\ntorque = " +
                      torque + "\nstiffness = " + stiffness + "\n");
}

void expect_believed(const Model& truth, const std::string& move) {
    const Recorded r(truth, move);
    for (const Model& model : {drive(), bare_drive()})
        for (const Suspicion& s : suspicions(model, r.motions))
            EXPECT_FALSE(s.refuses) << move << ": " << s.sentence;
}

} // namespace

TEST(Sanity, PreslidingIsNoShiftedTime) {
    expect_believed(with_bristles("0.06", "0.6"),
                    "sine:frequency_Hz=5,amplitude=0.3,periods=8,torque_noise=1e-3");
    expect_believed(with_bristles("0.1", "1.5"),
                    "sine:frequency_Hz=2,amplitude=1,periods=5,torque_noise=1e-3");
}

TEST(Sanity, BristlesThatBendATenthOfTheTravelAreNoShiftedTime) {
    for (const char* move : {"sine:frequency_Hz=2,amplitude=1,periods=5,torque_noise=1e-3",
                             "trapezoid:stroke=2,velocity=8,acceleration=100,cycles=3,"
                             "torque_noise=1e-3"})
        expect_believed(with_bristles("0.06", "0.3"), move);
}

TEST(Sanity, SmoothDragIsNoShiftedTime) {
    const char* sine = "sine:frequency_Hz=3,amplitude=3,periods=4,torque_noise=2e-3";
    expect_believed(drive("[effects.quadratic_drag]\ncoefficient = 1.2e-4\n"), sine);
    expect_believed(drive("[effects.custom.x]\nlaw = \"k*v^3\"\n[effects.custom.x.parameters]\n"
                          "k = 1e-6\n"),
                    sine);
}
