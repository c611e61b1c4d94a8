// What is found in a recording: time steps, sensor steps, wrapped positions, unit mistakes. Each
// check is also shown the honest recordings that it must leave alone.
#include "capture/checks.hpp"
#include "capture_helpers.hpp"
#include "common/text.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr double pi = std::numbers::pi;

using Law = std::function<double(double)>;

std::string csv_of_times(const std::vector<double>& times, int decimals,
                         const std::string& metadata = "") {
    std::string text = metadata + "time_s,torque_Nm,position_rad\n";
    for (const double t : times)
        text +=
            fmt::format("{:.{}f},{:.6f},{:.7f}\n", t, decimals, std::cos(9 * t), std::sin(9 * t));
    return text;
}

std::vector<double> grid(size_t rows, double step) {
    std::vector<double> times;
    for (size_t i = 0; i < rows; ++i)
        times.push_back(static_cast<double>(i) * step);
    return times;
}

// --- time

TEST(CaptureTime, CoarselyPrintedTimesAreUniformWhereTheSampleTimeIsStated) {
    for (const auto& [step, decimals] :
         {std::pair{125e-6, 4}, {62.5e-6, 5}, {62.5e-6, 6}, {1.0 / 3000, 4}}) {
        const std::string stated = "# sample_time_s = " + format_number(step) + "\n";
        const Capture capture = read_text(csv_of_times(grid(4000, step), decimals, stated));
        EXPECT_TRUE(capture.uniform) << step;
        EXPECT_EQ(capture.sample_time_s, step);
    }
}

TEST(CaptureTime, CoarselyPrintedTimesShowTheirMeanStepWhereNothingIsStated) {
    const Capture capture = read_text(csv_of_times(grid(4001, 62.5e-6), 6));
    EXPECT_TRUE(capture.uniform);
    EXPECT_NEAR(capture.sample_time_s, 62.5e-6, 1e-12);
}

TEST(CaptureTime, ALostRowIsFoundHoweverCoarseThePrint) {
    for (const int decimals : {4, 6, 9}) {
        auto times = grid(400, 125e-6);
        times.erase(times.begin() + 200);
        const std::string error =
            error_of_text(csv_of_times(times, decimals, "# sample_time_s = 0.000125\n"));
        // At 4 decimals the step before the gap may look like the gap.
        const bool found =
            error.find(decimals > 4 ? ":203: gap of 1 samples" : "test.csv:") != std::string::npos;
        EXPECT_TRUE(found) << decimals << " decimals: " << error;
    }
}

TEST(CaptureTime, RowsLostAtRandomAreNotTakenForOwnTimes) {
    std::mt19937_64 random(7);
    auto times = grid(1000, 0.001);
    std::erase_if(times, [&](double) { return random() % 10 == 0; });
    EXPECT_NE(error_of_text(csv_of_times(times, 4)).find("gap of"), std::string::npos);
}

TEST(CaptureTime, OwnTimesAreKept) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> step(0.0015, 0.0048);
    std::vector<double> times = {0};
    while (times.size() < 500)
        times.push_back(times.back() + step(random));
    const Capture capture = read_text(csv_of_times(times, 6));
    EXPECT_FALSE(capture.uniform);
    EXPECT_NEAR(capture.time_s[100], times[100], 1e-6);
    times.back() += 1;
    EXPECT_NE(error_of_text(csv_of_times(times, 6)).find(":501: gap of"), std::string::npos);
}

TEST(CaptureTime, StatedOwnTimesMayBeNearlyEven) {
    auto times = grid(200, 0.001);
    times[100] += 0.0004;
    EXPECT_NE(error_of_text(csv_of_times(times, 5)).find(":102: uneven time"), std::string::npos);
    EXPECT_FALSE(read_text(csv_of_times(times, 5, "# sampling = host loop, own times\n")).uniform);
}

TEST(CaptureTime, JitterBelowOnePerCentIsUniform) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> jitter(-4e-6, 4e-6);
    auto times = grid(500, 0.001);
    for (double& t : times)
        t += jitter(random);
    const Capture capture = read_text(csv_of_times(times, 9));
    EXPECT_TRUE(capture.uniform);
    EXPECT_NEAR(capture.sample_time_s, 0.001, 1e-7);
}

TEST(CaptureTime, StatedSampleTimeMustAgree) {
    EXPECT_EQ(error_of_text(csv_of_times(grid(100, 0.001), 4, "# sample_time_s = 0.001005\n")), "");
    EXPECT_NE(error_of_text(csv_of_times(grid(100, 0.001), 4, "# sample_time_s = 0.00102\n"))
                  .find(":1: metadata sample_time_s is 0.00102 s"),
              std::string::npos);
}

TEST(CaptureTime, ALateStartIsNoGap) {
    auto times = grid(100, 0.001);
    for (double& t : times)
        t += 86400;
    EXPECT_NEAR(read_text(csv_of_times(times, 4)).sample_time_s, 0.001, 1e-12);
}

// --- sensor steps

Printing print_of(int significant) { return {400, significant}; }

std::vector<double> sampled(size_t rows, const Law& law, double step, int digits) {
    std::vector<double> values;
    for (size_t i = 0; i < rows; ++i) {
        const double x = law(static_cast<double>(i) * 0.001);
        const double quantised = step > 0 ? std::floor(x / step) * step : x;
        values.push_back(std::stod(fmt::format("{:.{}g}", quantised, digits)));
    }
    return values;
}

TEST(Quantum, EncodersAreSeenThroughThePrint) {
    const Law sine = [](double t) { return 0.3 + 0.05 * std::sin(7 * t); };
    for (const int bits : {8, 13, 15, 17, 20}) {
        const double step = 2 * pi / std::ldexp(1, bits);
        for (const int digits : {9, 12, 17})
            EXPECT_NEAR(find_quantum(sampled(5000, sine, step, digits), print_of(digits)), step,
                        1e-4 * step)
                << bits << " bits, " << digits << " digits";
    }
}

TEST(Quantum, AFewStrayValuesDoNotHideIt) {
    const double step = 2 * pi / 131072;
    auto values = sampled(
        5000, [](double t) { return std::sin(3 * t); }, step, 12);
    for (size_t i = 0; i < values.size(); i += 500)
        values[i] += 0.37 * step;
    EXPECT_NEAR(find_quantum(values, print_of(12)), step, 1e-4 * step);
}

TEST(Quantum, ContinuousDataHaveNone) {
    for (const double rate : {0.3, 3.0, 31.0})
        EXPECT_EQ(find_quantum(sampled(
                                   5000, [=](double t) { return std::sin(rate * t); }, 0, 17),
                               print_of(17)),
                  0);
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise;
    EXPECT_EQ(find_quantum(sampled(
                               5000, [&](double) { return noise(random); }, 0, 17),
                           print_of(17)),
              0);
}

TEST(Quantum, CoarsePrintIsAStepToo) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0, 0.1);
    EXPECT_NEAR(find_quantum(
                    sampled(
                        5000, [&](double) { return std::round(noise(random) * 1e5) / 1e5; }, 0, 17),
                    {5, 5}),
                1e-5, 1e-12);
}

// Any few numbers lie near some lattice that is about as fine as their print.
TEST(Quantum, AFewCoarseNumbersAreNotTakenForAWiderLattice) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<double> values;
        for (int i = 0; i < 20; ++i)
            values.push_back(static_cast<double>(random() % 1000) / 1000);
        EXPECT_NEAR(find_quantum(values, {3, 3}), 1e-3, 1e-9) << "seed " << seed;
    }
}

TEST(Quantum, AConstantShowsNoStep) {
    EXPECT_EQ(find_quantum(std::vector<double>(100, 2.5), {1, 2}), 0);
    EXPECT_EQ(find_quantum(std::vector<double>(100, 0.0), {}), 0);
}

TEST(Quantum, MetadataOverrides) {
    const Capture capture = read_text("# position_quantum_rad = 4.8e-5\n# torque_quantum_Nm = 0\n" +
                                      sine_csv("time_s,torque_Nm,position_rad"));
    EXPECT_EQ(capture.position_quantum, 4.8e-5);
    EXPECT_EQ(capture.torque_quantum, 0);
}

// --- wrapped positions

std::string csv_of(const std::string& header, size_t rows, const Law& position) {
    std::string text = header + "\n";
    for (size_t i = 0; i < rows; ++i) {
        const double t = static_cast<double>(i) * 0.001;
        text += fmt::format("{:.3f},{:.3f},{:.9g}\n", t, std::cos(20 * t), position(t));
    }
    return text;
}

double wrap(double x, double turn) { return x - turn * std::floor(x / turn); }

TEST(Wrap, IsFoundAtAnySpeedAndDirection) {
    for (const double speed : {2.5, 31.0, -31.0, 900.0, -2000.0})
        for (const double start : {0.0, 0.1, 3.0, -1.0}) {
            const auto law = [=](double t) { return wrap(start + speed * t, 2 * pi); };
            const size_t rows = static_cast<size_t>(6000 / std::min(100.0, std::abs(speed))) + 200;
            const std::string error =
                error_of_text(csv_of("time_s,torque_Nm,position_rad", rows, law));
            EXPECT_NE(error.find("position looks wrapped"), std::string::npos)
                << speed << " " << start << " " << error;
        }
}

TEST(Wrap, JitterAtTheSeamIsFound) {
    const auto law = [](double t) { return wrap(0.01 * std::sin(300 * t), 2 * pi); };
    EXPECT_NE(
        error_of_text(csv_of("time_s,torque_Nm,position_rad", 200, law)).find("looks wrapped"),
        std::string::npos);
}

TEST(Wrap, HonestMotionIsLeftAlone) {
    const Law laws[] = {
        [](double t) { return 40 * t; },                // many turns
        [](double t) { return pi * std::sin(12 * t); }, // exactly one turn of stroke
        [](double t) {
            return t < 0.1 ? 0.0 : 2 * pi * std::min(1.0, 40 * (t - 0.1));
        },                                                 // a fast turn
        [](double t) { return 1e-4 * std::sin(900 * t); }, // a whisper
    };
    for (const Law& law : laws)
        EXPECT_EQ(error_of_text(csv_of("time_s,torque_Nm,position_rad", 400, law)), "");
}

// --- velocity against position

std::string both(double factor, double noise, double quantum) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal(0, noise);
    std::string text = "time_s,torque_Nm,position_rad,velocity_rad_s\n";
    for (int i = 0; i < 1000; ++i) {
        const double t = i * 0.001, x = 0.3 * std::sin(25 * t);
        const double seen = quantum > 0 ? std::floor(x / quantum) * quantum : x;
        text += fmt::format("{:.3f},0.1,{:.9g},{:.9g}\n", t, seen,
                            factor * 7.5 * std::cos(25 * t) + normal(random));
    }
    return text;
}

TEST(VelocityUnit, MistakesAreNamed) {
    const std::pair<double, const char*> mistakes[] = {
        {30 / pi, "rpm taken for rad/s"},
        {180 / pi, "degrees taken for radians"},
        {1 / (2 * pi), "revolutions taken for radians"},
        {1000, "mm taken for m"},
        {60, "rpm taken for rev/s"},
        {-1, "run opposite ways"},
        {3, "3"}};
    for (const auto& [factor, words] : mistakes) {
        const std::string error = error_of_text(both(factor, 0.05, 0));
        EXPECT_NE(error.find(words), std::string::npos) << factor << ": " << error;
    }
}

TEST(VelocityUnit, RightUnitsPassNoiseAndCoarseSensors) {
    for (const double noise : {0.0, 0.3, 3.0, 100.0})
        for (const double quantum : {0.0, 1e-4, 0.05})
            EXPECT_EQ(error_of_text(both(1, noise, quantum)), "") << noise << " " << quantum;
    EXPECT_EQ(error_of_text(both(0.8, 0, 0)), "") << "a filtered velocity is smaller";
}

TEST(VelocityUnit, AtRestNothingIsSaid) {
    std::string text = "time_s,torque_Nm,position_rad,velocity_rad_s\n";
    for (int i = 0; i < 100; ++i)
        text += fmt::format("{:.3f},0.1,0.25,0\n", i * 0.001);
    EXPECT_EQ(error_of_text(text), "");
}

} // namespace
