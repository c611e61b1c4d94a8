// Frequency response of one record to another against closed forms.
#include "story/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace servoid {
namespace {

using Vector = Eigen::VectorXd;

Vector noise(Eigen::Index count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Vector out(count);
    for (double& value : out)
        value = normal(random);
    return out;
}

// y[k] = 0.7 y[k−1] + 0.3 x[k]
Vector first_order(const Vector& x) {
    Vector out(x.size());
    double y = 0;
    for (Eigen::Index k = 0; k < x.size(); ++k)
        out[k] = y = 0.7 * y + 0.3 * x[k];
    return out;
}

std::complex<double> first_order_at(double frequency_Hz, double step_s) {
    const auto delay = std::polar(1.0, -2 * std::numbers::pi * frequency_Hz * step_s);
    return 0.3 / (1.0 - 0.7 * delay);
}

TEST(Transfer, OfNoiseThroughAFilter) {
    const Vector x = noise(40000, 5);
    const auto lines = transfer(x, first_order(x), 0.001, {std::nullopt, 400});
    ASSERT_GT(lines.size(), 1000U);
    for (const TransferLine& line : lines) {
        const auto truth = first_order_at(line.frequency_Hz, 0.001);
        EXPECT_NEAR(std::abs(line.response - truth), 0, 0.02 * std::abs(truth));
        EXPECT_GT(line.coherence, 0.99);
    }
    EXPECT_LE(lines.back().frequency_Hz, 400);
}

TEST(Transfer, TheDeviationIsTheScatter) {
    double sum = 0, expected = 0, count = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const Vector x = noise(9000, seed);
        const Vector y = 2 * x + 1.5 * noise(9000, 100 + seed);
        for (const TransferLine& line : transfer(x, y, 0.001, {std::nullopt, 450})) {
            if (line.frequency_Hz < 10) continue; // where the mean was taken
            const double error = std::abs(line.response) / 2 - 1;
            sum += error * error, expected += line.relative_std * line.relative_std, count += 1;
        }
    }
    const double ratio = std::sqrt(sum / expected);
    std::printf("figure: scatter of a gain over its stated deviation = %.3f (seeds 1..20)\n",
                ratio);
    EXPECT_GT(ratio, 0.75);
    EXPECT_LT(ratio, 1.35);
}

TEST(Transfer, AMoveThatRepeatsShowsItsLinesOnly) {
    // Lines at 5 and 15 Hz, a period of 0.2 s at 1 kHz; the output a quarter of a turn late.
    Vector x(2000), y(2000);
    for (Eigen::Index k = 0; k < 2000; ++k) {
        const double turn = 2 * std::numbers::pi * double(k) * 0.001;
        x[k] = std::cos(5 * turn) + 0.5 * std::cos(15 * turn);
        y[k] = 3 * std::sin(5 * turn) + 0.25 * std::cos(15 * turn);
    }
    const auto lines = transfer(x, y, 0.001, {0.2, 100});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_NEAR(lines[0].frequency_Hz, 5, 1e-9);
    EXPECT_NEAR(std::abs(lines[0].response - std::complex<double>(0, -3)), 0, 1e-9);
    EXPECT_NEAR(lines[1].frequency_Hz, 15, 1e-9);
    EXPECT_NEAR(std::abs(lines[1].response - 0.5), 0, 1e-9);
    EXPECT_NEAR(lines[1].coherence, 1, 1e-9);
}

TEST(Transfer, TooShortARecordSaysNothing) {
    EXPECT_TRUE(transfer(noise(40, 1), noise(40, 2), 0.001, {std::nullopt, 400}).empty());
}

} // namespace
} // namespace servoid
