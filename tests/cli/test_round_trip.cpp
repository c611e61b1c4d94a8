// simulate, identify, add, simulate again: each verb reads what the one before wrote. And what no
// capture can answer is refused with what to record instead.
#include "cli/run_program.hpp"

using namespace servoid::cli_test;

namespace {

// System 1 as someone believes it who forgot its Coulomb friction and has the inertia wrong.
std::string believed(const Folder& folder) {
    std::string text = text_of(example("system1.toml"));
    text.resize(text.find("[effects.coulomb]"));
    text.replace(text.find("0.116e-4"), 8, "0.150e-4");
    std::ofstream(folder / "believed.toml") << text;
    return folder / "believed.toml";
}

double at(const Json& json, const std::string& parameter) {
    return json.at("model_parameters").at(parameter).at("value").get<double>();
}

TEST(RoundTrip, AddFindsTheMissingFriction) {
    const Folder folder;
    const std::string csv =
        simulated(folder, example("system1.toml"),
                  "trapezoid:stroke=6.28,velocity=40,acceleration=1500,cycles=4", "run.csv");
    const Json json = json_of(
        run({"add", "coulomb", believed(folder), csv, "--out", folder / "better.toml", "--json"}));
    EXPECT_LT(json.at("error_after").get<double>(), 0.1 * json.at("error_before").get<double>());
    EXPECT_NEAR(at(json, "coulomb.torque"), 6.6e-3, 0.01 * 6.6e-3);
    EXPECT_NEAR(at(json, "inertia"), 0.116e-4, 0.01 * 0.116e-4);
    const Json again = json_of(run({"compare", folder / "better.toml", csv, "--json"}));
    EXPECT_NEAR(again.at("torque_error").get<double>(), json.at("error_after").get<double>(),
                1e-12);
    EXPECT_LT(again.at("loop").at("position_error").get<double>(), 1e-3);
}

TEST(RoundTrip, WhatAddWroteCanBeSimulated) {
    const Folder folder;
    const std::string csv =
        simulated(folder, example("system1.toml"), "trapezoid:cycles=2", "a.csv");
    ASSERT_EQ(
        run({"add", "constant_torque", example("system1.toml"), csv, "--out", folder / "b.toml"})
            .code,
        0);
    const std::string sine = simulated(folder, folder / "b.toml", "sine:frequency_Hz=80", "b.csv");
    const Json json = json_of(run({"identify", sine, "--model", folder / "b.toml", "--json"}));
    EXPECT_NEAR(json.at("frequency_Hz").get<double>(), 80, 0.1);
    EXPECT_NEAR(json.at("inertia").at("value").get<double>(), 0.116e-4, 0.01 * 0.116e-4);
}

TEST(RoundTrip, SeedDecidesTheCapture) {
    const Folder folder;
    const auto capture = [&](const std::string& seed, const std::string& name) {
        const Ended ended = run({"simulate", example("system1.toml"), "--experiment",
                                 "sine:torque_noise=1e-3", "--seed", seed, "--out", folder / name});
        EXPECT_EQ(ended.code, 0);
        return text_of(folder / name);
    };
    const std::string first = capture("5", "a.csv");
    EXPECT_EQ(first, capture("5", "b.csv"));
    EXPECT_NE(first, capture("6", "c.csv"));
}

void expect_refusal(const Ended& ended) {
    EXPECT_EQ(ended.code, 4) << ended.out << ended.err;
    EXPECT_TRUE(ended.err.starts_with("servoid: ")) << ended.err;
    EXPECT_NE(ended.err.find("record instead: "), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
}

TEST(Refusal, OneWayMotion) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"),
                                      "constant_speed:velocity=20,duration=1", "a.csv");
    const Ended identify = run({"identify", csv, "--json"});
    expect_refusal(identify);
    EXPECT_NE(identify.err.find("one way only"), std::string::npos) << identify.err;
    const Ended friction = run({"friction", csv, "--json"});
    expect_refusal(friction);
    EXPECT_NE(friction.err.find("one way only"), std::string::npos) << friction.err;
    expect_refusal(run({"add", "constant_torque", example("system1.toml"), csv, "--json"}));
}

TEST(Refusal, NoMotion) {
    const Folder folder;
    std::ofstream csv(folder / "still.csv");
    csv << "time_s,torque_ref_Nm,position_rad\n";
    for (int i = 0; i < 8000; ++i)
        csv << i * 125e-6 << "," << 1e-3 * ((i / 40) % 2) << ",1.5\n";
    csv.close();
    for (const auto& command :
         {std::vector<std::string>{"identify", folder / "still.csv"},
          std::vector<std::string>{"friction", folder / "still.csv"},
          std::vector<std::string>{"compare", example("system1.toml"), folder / "still.csv"},
          std::vector<std::string>{"add", "constant_torque", example("system1.toml"),
                                   folder / "still.csv"}}) {
        SCOPED_TRACE(command[0]);
        expect_refusal(run(command));
    }
}

} // namespace
