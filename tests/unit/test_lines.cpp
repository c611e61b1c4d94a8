// Odd and even lines of powers of a cosine, worked out by hand.
#include "compare/lines.hpp"
#include "plant/simulate.hpp"
#include "unit/motion_helpers.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace servoid;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kInertia = 0.01, kBand = 40;
constexpr double kA = 1.0, kB = 0.5;           // amplitudes of lines 1 and 3 of the position
constexpr double kCubic = 0.2, kSquare = 0.05; // of the residual

// x = A cos φ + B cos 3φ, one turn of φ a second.
double position_at(double t) { return kA * std::cos(kTurn * t) + kB * std::cos(3 * kTurn * t); }
double velocity_at(double t) {
    return -kTurn * (kA * std::sin(kTurn * t) + 3 * kB * std::sin(3 * kTurn * t));
}
double acceleration_at(double t) {
    return -kTurn * kTurn * (kA * std::cos(kTurn * t) + 9 * kB * std::cos(3 * kTurn * t));
}

// Amplitudes of x³: (A cos φ + B cos 3φ)³ multiplied out.
const double kCube1 = 0.75 * kA * kA * kA + 0.75 * kA * kA * kB + 1.5 * kA * kB * kB;
const double kCube3 = 0.25 * kA * kA * kA + 1.5 * kA * kA * kB + 0.75 * kB * kB * kB;
const double kCube5 = 0.75 * (kA * kA * kB + kA * kB * kB);
const double kCube7 = 0.75 * kA * kB * kB;
const double kCube9 = 0.25 * kB * kB * kB;
// And of x²: line 0, 2, 4, 6.
const double kSquare0 = 0.5 * (kA * kA + kB * kB);
const double kSquare2 = 0.5 * kA * kA + kA * kB;
const double kSquare4 = kA * kB;
const double kSquare6 = 0.5 * kB * kB;

double rms_of(std::initializer_list<double> amplitudes) {
    double sum = 0;
    for (double a : amplitudes)
        sum += a * a / 2;
    return std::sqrt(sum);
}

struct Made {
    Capture capture;
    explicit Made(double noise = 0, double seconds = 9, unsigned seed = 1) {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> gauss(0, 1);
        capture = sampled([](const Kinematics&, double) { return 0.0; }, seconds);
        for (size_t i = 0; i < capture.rows(); ++i) {
            const double t = capture.time_s[i], x = position_at(t);
            capture.position[i] = x;
            capture.position_ref.push_back(x);
            capture.torque_ref[i] = kInertia * acceleration_at(t) + kCubic * x * x * x +
                                    kSquare * x * x + noise * gauss(random);
        }
        capture.period_s = 1;
    }
    // The inertia is known, the powers of the position are not.
    std::optional<Lines> lines(int periods = 100) const {
        const PreparedMotion m = prepare_motion(capture, {kBand, {}});
        const Eigen::VectorXd residual = m.torque - kInertia * m.acceleration;
        return lines_of({{m, residual, periods}});
    }
};

double torque_rms() {
    const double inertia = -kInertia * kTurn * kTurn;
    const double ac = rms_of({inertia * kA + kCubic * kCube1, inertia * 9 * kB + kCubic * kCube3,
                              kCubic * kCube5, kCubic * kCube7, kCubic * kCube9, kSquare * kSquare2,
                              kSquare * kSquare4, kSquare * kSquare6});
    return std::hypot(ac, kSquare * kSquare0);
}

void expect_the_truth(const Lines& lines) {
    const double one = torque_rms(), close = 2e-4;
    const double odd = kCubic * rms_of({kCube5, kCube7, kCube9}) / one;
    const double even = kSquare * rms_of({kSquare2, kSquare4, kSquare6}) / one;
    EXPECT_NEAR(lines.base_Hz, 1, 1e-9);
    EXPECT_NEAR(lines.residual.excited, kCubic * rms_of({kCube1, kCube3}) / one, 5e-4)
        << "the inertia's lines too: the smoothing of the motion has a ripple of 2e-4";
    EXPECT_NEAR(lines.residual.odd, odd, close);
    EXPECT_NEAR(lines.residual.even, even, close);
    EXPECT_NEAR(lines.mean, kSquare * kSquare0 / one, close);
    EXPECT_NEAR(lines.torque.odd, odd, close) << "an inertia puts nothing there";
    EXPECT_NEAR(lines.torque.even, even, close);
    EXPECT_LT(lines.between, close);
    EXPECT_EQ(lines.counts.excited, 2);
}

TEST(Lines, PowersOfACosine) {
    const auto lines = Made().lines();
    ASSERT_TRUE(lines);
    expect_the_truth(*lines);
    EXPECT_EQ(lines->counts.even, 29) << "2, 4 … 58 Hz: 1.45 of the band";
    EXPECT_EQ(lines->counts.odd, 27) << "5, 7 … 57 Hz";
}

TEST(Lines, VelocityReference) {
    Made made;
    made.capture.velocity_ref.clear();
    for (double t : made.capture.time_s)
        made.capture.velocity_ref.push_back(velocity_at(t));
    made.capture.position_ref.clear();
    const auto lines = made.lines();
    ASSERT_TRUE(lines);
    expect_the_truth(*lines);
}

// A stated period may hold several of the move's.
TEST(Lines, PeriodOfSeveralCycles) {
    Made made;
    made.capture.period_s = 3;
    const auto lines = made.lines();
    ASSERT_TRUE(lines);
    expect_the_truth(*lines);
}

// Without a reference the torque is the excitation: what it holds itself is no detection line.
TEST(Lines, TorqueAsTheExcitation) {
    Made made;
    made.capture.position_ref.clear();
    for (size_t i = 0; i < made.capture.rows(); ++i) // no even part
        made.capture.torque_ref[i] -= kSquare * std::pow(made.capture.position[i], 2);
    const auto lines = made.lines();
    ASSERT_TRUE(lines);
    EXPECT_EQ(lines->counts.excited, 5);
    EXPECT_LT(lines->residual.odd, 2e-4);
    EXPECT_LT(lines->residual.even, 2e-4);
}

TEST(Lines, Sine) {
    Made made;
    const double a = 0.7, w = kTurn * 2;
    for (size_t i = 0; i < made.capture.rows(); ++i) {
        const double x = a * std::cos(w * made.capture.time_s[i]);
        made.capture.position[i] = made.capture.position_ref[i] = x;
        made.capture.torque_ref[i] = -kInertia * w * w * x + kCubic * x * x * x + kSquare * x * x;
    }
    const auto lines = made.lines(); // the stated period holds two of the sine's
    ASSERT_TRUE(lines);
    EXPECT_NEAR(lines->base_Hz, 2, 1e-9);
    EXPECT_EQ(lines->counts.excited, 1);
    // cos³ = ¾ cos φ + ¼ cos 3φ, cos² = ½ + ½ cos 2φ
    const double cube = kCubic * a * a * a, square = kSquare * a * a;
    const double one = std::hypot(
        rms_of({-kInertia * w * w * a + 0.75 * cube, 0.25 * cube, 0.5 * square}), 0.5 * square);
    EXPECT_NEAR(lines->residual.excited, rms_of({0.75 * cube}) / one, 2e-4);
    EXPECT_NEAR(lines->residual.odd, rms_of({0.25 * cube}) / one, 2e-4);
    EXPECT_NEAR(lines->residual.even, rms_of({0.5 * square}) / one, 2e-4);
}

// White noise σ: after the band limit, over the root of the periods that were averaged.
TEST(Lines, NoiseLiesBetweenThem) {
    constexpr double kNoise = 0.05;
    double between = 0, even = 0, truth = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const Made made(kNoise, 9, seed);
        const PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
        const auto lines = made.lines();
        ASSERT_TRUE(lines);
        between += std::pow(lines->between, 2) / 20;
        even += std::pow(lines->noise.even, 2) / 20;
        truth = kNoise * m.low_pass->noise_gain(0) / std::sqrt(8.0) / torque_rms();
    }
    EXPECT_NEAR(std::sqrt(between) / truth, 1, 0.05);
    EXPECT_NEAR(even / between, 0.5, 0.03) << "every other line is even";
}

TEST(Lines, OnePeriodHasNothingBetween) {
    const auto lines = Made().lines(1);
    ASSERT_TRUE(lines);
    EXPECT_TRUE(std::isnan(lines->between));
    EXPECT_NEAR(lines->residual.odd, kCubic * rms_of({kCube5, kCube7, kCube9}) / torque_rms(),
                2e-4);
}

// x³ of lines 1 and 2 lands on even lines too: nothing can be said of parity.
TEST(Lines, NoneWhereEvenLinesAreExcited) {
    Made made;
    for (size_t i = 0; i < made.capture.rows(); ++i)
        made.capture.position_ref[i] += 0.1 * std::cos(2 * kTurn * made.capture.time_s[i]);
    EXPECT_FALSE(made.lines());
}

TEST(Lines, NoneWithoutAPeriod) {
    const Made made;
    PreparedMotion m = prepare_motion(made.capture, {kBand, {}});
    EXPECT_TRUE(lines_of({{m, m.torque, 8}}));
    m.period_s.reset();
    EXPECT_FALSE(lines_of({{m, m.torque, 8}}));
}

// Stretches at rest are cut out, which spreads the lines: no sharp odd ones. Half a period away the
// same is cut out, so that even ones stay apart.
TEST(Lines, RestLeavesTheEvenOnes) {
    const Model model = parse_model(
        "motion = \"rotary\"\n[plant]\ninertia = 5.56e-5\n[controller]\ntype = \"p_pi\"\n"
        "position_gain = 40.0\nspeed_gain = 7e-3\nintegral_time = 0.016\nsample_time = 125e-6\n"
        "[sensor]\ncounts_per_rev = 131072\n[drive]\nrated_torque = 0.637\n"
        "[effects.viscous]\ncoefficient = 9.6e-4\n[effects.coulomb]\ntorque = 2.1e-2\n",
        "slider");
    const Capture c = simulate(model, parse_experiment("trapezoid:dwell=0.2,cycles=4"), 1);
    const PreparedMotion m = prepare_motion(c, {});
    ASSERT_LT(m.used_count(), m.grid.count * 9 / 10);
    const auto lines = lines_of({{m, m.torque, 2}});
    ASSERT_TRUE(lines);
    EXPECT_TRUE(std::isnan(lines->residual.odd));
    EXPECT_GT(lines->residual.excited, 0.9);
    EXPECT_LT(lines->residual.even, 0.03) << "a symmetric axis has none";
}

TEST(Lines, CapturesOfDifferentBases) {
    const Made one;
    Made two;
    for (double& t : two.capture.time_s)
        t *= 0.5;
    two.capture.sample_time_s *= 0.5, two.capture.period_s = 0.5;
    const PreparedMotion a = prepare_motion(one.capture, {kBand, {}});
    const PreparedMotion b = prepare_motion(two.capture, {kBand, {}});
    const auto lines = lines_of({{a, a.torque, 8}, {b, b.torque, 8}});
    ASSERT_TRUE(lines);
    EXPECT_TRUE(std::isnan(lines->base_Hz));
    EXPECT_NEAR(lines->residual.even,
                kSquare * rms_of({kSquare2, kSquare4, kSquare6}) / torque_rms(), 2e-4);
}

} // namespace
