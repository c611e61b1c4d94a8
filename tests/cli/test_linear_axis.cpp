// A linear axis whose cogging is known by its length in metres, through diagnose, add and refine.
#include "cli/run_program.hpp"

using namespace servoid::cli_test;

namespace {

const std::string move =
    "trapezoid:stroke=0.03,velocity=0.03,acceleration=1,cycles=3,torque_noise=0.5";

const std::string axis = R"(name = "slide"
motion = "linear"
[plant]
inertia = 100.0
[controller]
type = "p_p"
position_gain = 160.0
speed_gain = 8557.0
sample_time = 1e-3
[sensor]
metres_per_count = 5e-8
[effects.viscous]
coefficient = 200.0
)";

const std::string cogging = "[[effects.cogging]]\namplitude = 8.0\nperiod = 0.0025\nphase = 0.4\n";
const std::string coulomb = "[effects.coulomb]\ntorque = 20.0\n";

std::string written(const Folder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
}

TEST(Period, IsKeptWhereSomethingElseIsMissing) {
    const Folder folder;
    const std::string csv =
        simulated(folder, written(folder, "truth.toml", axis + coulomb + cogging), move, "a.csv");
    const std::string known = written(folder, "known.toml", axis + cogging);
    const Json found = json_of(run({"diagnose", known, csv, "--json"}));
    EXPECT_EQ(found.at("verdict"), "missing");
    EXPECT_EQ(found.at("candidates").at(0).at("effect"), "coulomb");
    const Json& period = found.at("model_parameters").at("cogging.period");
    EXPECT_EQ(period.at("unit"), "m");
    EXPECT_NEAR(period.at("value").get<double>(), 0.0025, 2e-5);
    const Json added = json_of(run({"add", "coulomb", known, csv, "--json"}));
    EXPECT_NEAR(added.at("model").at("effects").at("cogging").at(0).at("period").get<double>(),
                0.0025, 2e-6);
    EXPECT_EQ(json_of(run({"refine", known, csv, "--json"})).at("verdict"), "adequate");
}

// What is found by itself is in cycles per metre, beside a wave that is known by its length.
TEST(Period, StandsBesideAnOrder) {
    const Folder folder;
    const std::string second = "[[effects.cogging]]\namplitude = 6.0\norder = 700.0\nphase = 1.0\n";
    const std::string csv = simulated(
        folder, written(folder, "truth.toml", axis + coulomb + cogging + second), move, "a.csv");
    const std::string known = written(folder, "known.toml", axis + coulomb + cogging);
    const Json found = json_of(run({"diagnose", known, csv, "--json"}));
    const Json& best = found.at("candidates").at(0);
    EXPECT_EQ(best.at("effect"), "cogging");
    EXPECT_EQ(best.at("parameters").at("order").at("unit"), "1/m");
    EXPECT_NEAR(best.at("parameters").at("order").at("value").get<double>(), 700, 1);
    const std::string better = folder / "better.toml";
    const Json added = json_of(run({"add", "cogging", known, csv, "--out", better, "--json"}));
    const Json& waves = added.at("model").at("effects").at("cogging");
    EXPECT_NEAR(waves.at(0).at("period").get<double>(), 0.0025, 2e-6);
    EXPECT_NEAR(waves.at(1).at("order").get<double>(), 700, 1);
    EXPECT_EQ(json_of(run({"diagnose", better, csv, "--json"})).at("verdict"), "adequate");
}

} // namespace
