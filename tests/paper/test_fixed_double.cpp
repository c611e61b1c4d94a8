// The fixed-point core against double-precision least squares on the same samples of whole
// captures.
#include "identify/core_window.hpp"
#include "paper/paper.hpp"
#include "plant/simulate.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::paper;

namespace {

using Vector = Eigen::VectorXd;

Vector as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
}

// [cos, sin, 1, t, t², t³] over the window.
Eigen::MatrixXd regressors(const WindowTask& task) {
    Eigen::MatrixXd x(task.count, 6);
    for (Eigen::Index i = 0; i < task.count; ++i) {
        const double p = kTurn * task.frequency_Hz * task.scale.sample_time_s * double(i);
        const double t = 2 * double(i) / double(task.count - 1) - 1;
        x.row(i) << std::cos(p), std::sin(p), 1, t, t * t, t * t * t;
    }
    return x;
}

// J = −Re(T·Θ*)/(ω²|Θ|²), the torque turned by its half sample of hold and raised by the hold's
// gain.
double inertia_in_double(const Vector& torque, const Vector& position, const WindowTask& task) {
    const auto qr = regressors(task).colPivHouseholderQr();
    const Vector t = qr.solve(torque.segment(task.first, task.count));
    const Vector p = qr.solve(position.segment(task.first, task.count));
    const double w = kTurn * task.frequency_Hz, half = w * task.scale.sample_time_s / 2;
    const std::complex<double> hold = std::polar(std::sin(half) / half, -half);
    const std::complex<double> motor = std::complex<double>(t[0], -t[1]) * hold;
    const std::complex<double> motion(p[0], -p[1]);
    return -(motor * std::conj(motion)).real() / (w * w * std::norm(motion));
}

// Encoders finer than 2^22 counts of travel are scaled by choose_scale, as identify does it.
double difference(int system_number, int bits, double frequency_Hz) {
    const Model model = with_bits(system(system_number), bits);
    const Capture c =
        simulate(model, parse_experiment(fmt::format("sine:frequency_Hz={}", frequency_Hz)), 1);
    const Vector torque = as_vector(c.torque_ref), position = as_vector(c.position);
    WindowTask task;
    task.frequency_Hz = frequency_Hz;
    task.first = std::lround(8 / (frequency_Hz * kSample));
    task.count = Eigen::Index(c.rows()) - task.first;
    task.scale =
        choose_scale(torque.segment(task.first, task.count),
                     position.segment(task.first, task.count), kRated, c.position_quantum, kSample);
    const WindowResult fixed = run_window(torque, position, task);
    EXPECT_EQ(fixed.reason, SID_OK);
    return fixed.inertia / inertia_in_double(torque, position, task) - 1;
}

class FixedAgainstDouble : public testing::TestWithParam<int> {};

TEST_P(FixedAgainstDouble, Inertia) {
    for (const int bits : {15, 17, 18, 20, 22, 24}) {
        double worst = 0;
        for (double f = 10; f <= 200; f += 10) {
            SCOPED_TRACE(fmt::format("{} bit, {} Hz", bits, f));
            const double d = difference(GetParam(), bits, f);
            EXPECT_LE(std::abs(d), 1e-4);
            worst = std::max(worst, std::abs(d));
        }
        figure(
            fmt::format("fixed against double, system {}, {} bit, largest |ΔJ|/J of 10 to 200 Hz",
                        GetParam(), bits),
            worst, "", "at most 1e-4");
    }
}

INSTANTIATE_TEST_SUITE_P(Systems, FixedAgainstDouble, testing::Values(1, 2),
                         [](const testing::TestParamInfo<int>& test) {
                             return "System" + std::to_string(test.param);
                         });

} // namespace
