// What the simulated drive's encoder shows of the axis: its error, its noise, its counts.
#include "plant/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace servoid;

namespace {

Model resting() {
    Model model;
    model.inertia = 2e-5;
    model.controller = Controller{Controller::Type::p_pi, 40, 3e-3, 0.016, 125e-6, 1};
    model.sensor.position_per_count = 1e-5;
    return model;
}

AxisDescription stuck_axis() {
    AxisDescription axis;
    axis.inertia = 2e-5;
    axis.coulomb_forward = axis.coulomb_reverse = 1e3;
    return axis;
}

} // namespace

TEST(AxisSensor, TheErrorIsOfTheTruePosition) {
    AxisDescription axis = stuck_axis();
    axis.sensor_error = [](double x) { return 0.01 * std::sin(x + 0.5); };
    SimulatedDrive drive(resting(), {}, axis);
    for (const double x : {-2.0, 0.0, 0.3, 5.0}) {
        drive.set_state(x, 0);
        EXPECT_EQ(drive.counts(), std::lround((x + 0.01 * std::sin(x + 0.5)) / 1e-5)) << x;
    }
}

TEST(AxisSensor, NoiseIsWhiteOfItsDeviationAndCounted) {
    DriveOptions options;
    options.position_noise = 2e-4;
    SimulatedDrive drive(resting(), options, stuck_axis());
    double sum = 0, squares = 0, products = 0, last = 0;
    const int samples = 20000;
    for (int i = 0; i < samples; ++i) {
        const int32_t shown = drive.counts();
        const DriveSample sample = drive.step(0);
        ASSERT_EQ(sample.counts, shown); // looking does not change what is seen
        sum += sample.position, squares += sample.position * sample.position;
        products += sample.position * last;
        last = sample.position;
    }
    EXPECT_NEAR(sum / samples, 0, 4 * 2e-4 / std::sqrt(samples));
    EXPECT_NEAR(std::sqrt(squares / samples), 2e-4, 0.03 * 2e-4);
    EXPECT_NEAR(products / squares, 0, 0.03);
}

TEST(AxisSensor, PositionNoiseLeavesTheTorqueNoiseAsItWas) {
    Model model = resting();
    model.controller->position_gain_per_s = 1e-3; // as good as open
    model.controller->speed_gain = 1e-9;
    DriveOptions plain, noisy;
    plain.torque_noise = noisy.torque_noise = 1e-2;
    plain.full_torque = noisy.full_torque = 1;
    noisy.position_noise = 1e-9;
    AxisDescription axis;
    axis.inertia = 2e-5;
    SimulatedDrive a(model, plain, axis), b(model, noisy, axis);
    for (int i = 0; i < 200; ++i)
        a.step(0), b.step(0);
    EXPECT_NE(a.counts(), 0);
    EXPECT_NEAR(a.counts(), b.counts(), 1);
}
