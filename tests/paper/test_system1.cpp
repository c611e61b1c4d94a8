// Table V, system 1 (the motor alone), against the simulated drive that runs the core itself.
#include "identify/sweep.hpp"
#include "paper/paper.hpp"

#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::paper;

namespace {

const Sweep& the_sweep() {
    static const Sweep s = sweep(system(1), {});
    return s;
}

TEST(System1, ModelFileHoldsTableI) {
    const Model m = system(1);
    EXPECT_DOUBLE_EQ(m.inertia, kInertia1);
    EXPECT_DOUBLE_EQ(m.find("viscous")->at("coefficient"), 0.75e-4);
    EXPECT_DOUBLE_EQ(m.find("coulomb")->at("torque"), 6.6e-3);
    EXPECT_DOUBLE_EQ(m.drive.rated_torque, kRated);
    EXPECT_DOUBLE_EQ(m.sensor.position_per_count, kTurn / (1 << 17));
    EXPECT_DOUBLE_EQ(m.controller->sample_time_s, kSample);
    EXPECT_DOUBLE_EQ(m.controller->position_gain_per_s, 40);
    EXPECT_NEAR(m.controller->speed_gain, 40 * kTurn * kInertia1, 1e-11);
    EXPECT_NEAR(m.controller->integral_time_s, 4 / (40 * kTurn), 1e-11);
}

TEST(System1, AmplitudesOfTableV) {
    ASSERT_EQ(the_sweep().points.size(), 20u);
    const double first = the_sweep().points.front().answer.position_amplitude;
    const double last = the_sweep().points.back().answer.position_amplitude;
    figure("system 1, position amplitude at 10 Hz", first, "rad", "0.62");
    figure("system 1, position amplitude at 200 Hz", last, "rad", "0.006");
    EXPECT_NEAR(first, 0.62, 0.005);
    EXPECT_NEAR(last, 0.006, 0.0005);
}

TEST(System1, TorqueAt200Hz) {
    const double percent = 100 * the_sweep().points.back().answer.torque_amplitude / kRated;
    figure("system 1, torque amplitude at 200 Hz", percent, "% of rated", "18.6 ± 0.2");
    EXPECT_NEAR(percent, 18.6, 0.2);
}

TEST(System1, InertiaAtEachFrequency) {
    double worst = 0;
    for (const SweepPoint& p : the_sweep().points) {
        SCOPED_TRACE(p.answer.frequency_Hz);
        EXPECT_EQ(p.answer.reason, SID_OK);
        const double error = (p.answer.inertia / kInertia1 - 1) * 100;
        EXPECT_LE(std::abs(error), 1.5);
        EXPECT_NEAR(p.error_percent, error, 1e-9);
        if (std::abs(error) > std::abs(worst)) worst = error;
    }
    figure("system 1, largest error of J over 10 to 200 Hz", worst, "%", "within ±1.5, paper ±3");
}

// The longest of the plan's runs: ten periods of 10 Hz.
TEST(System1, OneFrequencyTakesAtMostASecond) {
    SimulatedDrive drive(system(1), {});
    long samples = 0;
    run_session(drive, {{10, 1.0}}, {}, [&](const DriveSample&) { ++samples; });
    const double seconds = double(samples) * kSample;
    figure("system 1, time of one frequency at 10 Hz", seconds, "s", "at most 1, and one poll");
    EXPECT_LE(seconds, 1.05);
}

TEST(System1, OneInertiaFromAllFrequencies) {
    const Estimate j = the_sweep().corrected.inertia;
    const double error = (j.value / kInertia1 - 1) * 100;
    figure("system 1, error of inertia_corrected", error, "%", "within ±1.5");
    EXPECT_LE(std::abs(error), 1.5);
    EXPECT_LE(std::abs(j.value - kInertia1), 3 * j.std);
}

} // namespace
