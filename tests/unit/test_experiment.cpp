// The experiments' text form: every kind, its defaults, its file, and what is wrong with wrong
// ones.
#include "common/error.hpp"
#include "plant/experiment.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

using namespace servoid;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

TEST(Experiment, SineFromRest) {
    const Experiment e = parse_experiment("sine:frequency_Hz=50,amplitude=0.5,periods=8");
    EXPECT_EQ(e.text, "sine:frequency_Hz=50,amplitude=0.5,periods=8");
    EXPECT_DOUBLE_EQ(e.duration_s, 8 / 50.0);
    EXPECT_DOUBLE_EQ(*e.period_s, 0.02);
    for (double t : {0.0, 0.001, 0.005, 0.0123})
        EXPECT_NEAR(e.position_ref(t), 0.5 * std::sin(kTurn * 50 * t), 1e-12);
}

TEST(Experiment, DefaultsWithoutKeys) {
    for (const char* kind :
         {"sine", "multisine", "trapezoid", "constant_speed", "speeds", "staircase"}) {
        const Experiment e = parse_experiment(kind);
        EXPECT_GT(e.duration_s, 0) << kind;
        EXPECT_NEAR(e.position_ref(0), 0, 1e-12) << kind;
        EXPECT_EQ(e.torque_noise, 0) << kind;
    }
}

TEST(Experiment, MultisineRepeatsAndItsSeedDecides) {
    const auto at = [](const char* text, double t) {
        return parse_experiment(text).position_ref(t);
    };
    const Experiment e = parse_experiment("multisine:from_Hz=5,to_Hz=50,step_Hz=5,periods=3");
    EXPECT_DOUBLE_EQ(*e.period_s, 0.2);
    EXPECT_DOUBLE_EQ(e.duration_s, 0.6);
    EXPECT_NEAR(e.position_ref(0.033), e.position_ref(0.233), 1e-12);
    EXPECT_EQ(at("multisine:seed=3", 0.03), at("multisine:seed=3", 0.03));
    EXPECT_NE(at("multisine:seed=3", 0.03), at("multisine:seed=4", 0.03));
}

// Odd lines only: the move repeats after two of what the step says.
TEST(Experiment, MultisineWhoseLinesStartOffTheStep) {
    const Experiment odd =
        parse_experiment("multisine:from_Hz=5,to_Hz=95,step_Hz=10,amplitude=0.5,periods=4");
    EXPECT_NEAR(*odd.period_s, 0.2, 1e-12);
    EXPECT_NEAR(odd.duration_s, 0.8, 1e-12);
    EXPECT_NEAR(odd.position_ref(0.033), odd.position_ref(0.233), 1e-12);
    EXPECT_GT(std::abs(odd.position_ref(0.033) - odd.position_ref(0.133)), 0.01);
    const Experiment fine = parse_experiment("multisine:from_Hz=0.3,to_Hz=3,step_Hz=0.2");
    EXPECT_NEAR(*fine.period_s, 10, 1e-9);
}

TEST(Experiment, TrapezoidKeepsItsLimits) {
    const Experiment e =
        parse_experiment("trapezoid:stroke=10,velocity=20,acceleration=400,dwell=0.1,cycles=2");
    const double leg = 10 / 20.0 + 20 / 400.0 + 0.1, h = 1e-4;
    EXPECT_DOUBLE_EQ(*e.period_s, 2 * leg);
    EXPECT_DOUBLE_EQ(e.duration_s, 4 * leg);
    EXPECT_NEAR(e.position_ref(leg - 0.05), 10, 1e-12);
    EXPECT_NEAR(e.position_ref(2 * leg - 0.05), 0, 1e-9);
    double top = 0, steepest = 0;
    for (double t = 2 * h; t < e.duration_s; t += h) {
        const double p0 = e.position_ref(t - 2 * h), p1 = e.position_ref(t - h),
                     p2 = e.position_ref(t);
        top = std::max(top, std::abs(p2 - p1) / h);
        steepest = std::max(steepest, std::abs(p2 - 2 * p1 + p0) / (h * h));
    }
    EXPECT_NEAR(top, 20, 1e-6);
    EXPECT_NEAR(steepest, 400, 1e-3);
}

TEST(Experiment, ShortTrapezoidIsATriangle) {
    const Experiment e =
        parse_experiment("trapezoid:stroke=1,velocity=50,acceleration=100,cycles=1");
    EXPECT_NEAR(*e.period_s, 2 * 2 * std::sqrt(1 / 100.0), 1e-12);
    EXPECT_NEAR(e.position_ref(*e.period_s / 2), 1, 1e-12);
}

TEST(Experiment, ConstantSpeedEitherWay) {
    for (double v : {20.0, -20.0}) {
        const Experiment e =
            parse_experiment("constant_speed:duration=2,velocity=" + std::to_string(v));
        EXPECT_NEAR((e.position_ref(1.5) - e.position_ref(0.5)), v, 1e-9);
        EXPECT_FALSE(e.period_s);
    }
}

TEST(Experiment, SpeedsAreSegmentsBothWays) {
    const Experiment e = parse_experiment("speeds:from=10,to=30,count=3,duration=1");
    EXPECT_DOUBLE_EQ(e.duration_s, 6);
    const double asked[] = {10, -10, 20, -20, 30, -30};
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(e.segment(i + 0.5), i);
        EXPECT_NEAR(e.position_ref(i + 0.9) - e.position_ref(i + 0.4), asked[i] / 2, 1e-9) << i;
        EXPECT_NEAR(e.position_ref(i + 1 - 1e-9), e.position_ref(i + 1.0), 1e-6) << "a jump";
    }
}

TEST(Experiment, RestComesFirst) {
    const Experiment e = parse_experiment("sine:frequency_Hz=10,rest=0.5,torque_noise=0.01");
    EXPECT_DOUBLE_EQ(e.duration_s, 1.5);
    EXPECT_EQ(e.position_ref(0.4), 0);
    EXPECT_NEAR(e.position_ref(0.525), 1, 1e-12);
    EXPECT_EQ(e.torque_noise, 0.01);
}

TEST(Experiment, StaircaseGoesThereAndBackAtEachSpeed) {
    const Experiment e =
        parse_experiment("staircase:stroke=10,from=20,to=40,count=3,acceleration=400,cycles=2");
    double length = 0;
    for (double v : {20.0, 30.0, 40.0}) {
        const double leg = 10 / v + v / 400, middle = length + leg / 2, h = 1e-3;
        EXPECT_NEAR(e.position_ref(length), 0, 1e-9);
        EXPECT_NEAR(e.position_ref(length + leg), 10, 1e-9);
        EXPECT_NEAR((e.position_ref(middle + h) - e.position_ref(middle - h)) / (2 * h), v, 1e-6);
        EXPECT_NEAR(e.position_ref(length + 2 * leg - leg / 2), 5, 1e-9);
        length += 2 * leg;
    }
    EXPECT_DOUBLE_EQ(*e.period_s, length);
    EXPECT_DOUBLE_EQ(e.duration_s, 2 * length);
    EXPECT_NEAR(e.position_ref(0.3), e.position_ref(0.3 + length), 1e-9);
}

TEST(Experiment, StartIsWhereTheAxisStands) {
    const Experiment e = parse_experiment("trapezoid:stroke=2,cycles=2,start=-1.5,rest=0.1");
    EXPECT_EQ(e.start, -1.5);
    EXPECT_DOUBLE_EQ(e.position_ref(0.05), -1.5);
    const Model model = read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system1.toml");
    const Capture there = simulate(model, e, 1);
    const Capture here =
        simulate(model, parse_experiment("trapezoid:stroke=2,cycles=2,rest=0.1"), 1);
    const double count = there.position_quantum;
    EXPECT_NEAR(there.position.front(), -1.5, count);
    EXPECT_EQ(there.position_ref.front(), -1.5);
    for (size_t i = 0; i < here.rows(); i += 50)
        ASSERT_NEAR(there.position[i] + 1.5, here.position[i], 20 * count) << i;
}

std::string usage_error(const std::string& text) {
    try {
        parse_experiment(text);
    } catch (const UsageError& e) {
        return e.what();
    }
    return "accepted";
}

TEST(Experiment, WrongTextIsNamed) {
    EXPECT_NE(usage_error("sin").find("no kind sin"), std::string::npos);
    EXPECT_NE(usage_error("sine:frequency=10").find("no key frequency"), std::string::npos);
    EXPECT_NE(usage_error("sine:frequency_Hz").find("key=number"), std::string::npos);
    EXPECT_NE(usage_error("sine:frequency_Hz=").find("key=number"), std::string::npos);
    EXPECT_NE(usage_error("sine:frequency_Hz=10Hz").find("key=number"), std::string::npos);
    for (const char* text :
         {"sine:frequency_Hz=0", "sine:frequency_Hz=-1", "sine:amplitude=nan", "sine:periods=inf",
          "sine:torque_noise=-1", "sine:rest=-1", "trapezoid:dwell=-1", "speeds:count=0",
          "staircase:count=0", "sine:start=inf"})
        EXPECT_NE(usage_error(text).find("out of range"), std::string::npos) << text;
    for (const char* text : {"staircase:from=-5", "staircase:to=0", "staircase:count=1e9"})
        EXPECT_NE(usage_error(text).find("1000 speeds above zero"), std::string::npos) << text;
    EXPECT_NE(usage_error("constant_speed:duration=4000").find("hour"), std::string::npos);
}

struct File {
    explicit File(const std::string& text)
        : path(std::filesystem::temp_directory_path() /
               ("servoid_experiment_" + std::to_string(::getpid()) + ".toml")) {
        std::ofstream(path) << text;
    }
    ~File() { std::filesystem::remove(path); }
    std::filesystem::path path;
};

TEST(Experiment, FromAFile) {
    const File file("kind = \"sine\"\nfrequency_Hz = 25\namplitude = 0.25\n");
    const Experiment e = parse_experiment(file.path);
    EXPECT_DOUBLE_EQ(*e.period_s, 0.04);
    EXPECT_NEAR(e.position_ref(0.01), 0.25, 1e-12);
}

TEST(Experiment, WrongFilesEndAsBadFiles) {
    for (const char* text : {"kind = \"sine\"\nfrequency = 25\n", "frequency_Hz = 25\n",
                             "kind = \"sine\"\nfrequency_Hz = \"25\"\n", "kind = \n"}) {
        const File file(text);
        EXPECT_THROW(parse_experiment(file.path), FileError) << text;
    }
    EXPECT_THROW(parse_experiment("no/such/file.toml"), FileError);
}

} // namespace
