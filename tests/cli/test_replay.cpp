// A candump log through the program: the same inertia as the CSV of the same run.
#include "cli/run_program.hpp"

#include <cmath>
#include <cstdio>

using namespace servoid::cli_test;

namespace {

const std::string sine = "sine:frequency_Hz=50,periods=20,amplitude=0.5";

double inertia_of(const Ended& ended) {
    return json_of(ended).at("inertia").at("value").get<double>();
}

std::string write(const Folder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
}

} // namespace

TEST(Replay, GivesTheInertiaOfTheCsv) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string csv = simulated(folder, model, sine, "a.csv");
    const std::string log = simulated(folder, model, sine, "a.log");
    const double of_csv = inertia_of(run({"identify", csv, "--model", model, "--json"}));
    const Ended replayed = run({"replay", log, "--profile", "cia402", "--objects", "6041", "6064",
                                "6074", "--model", model, "--json"});
    const double off = inertia_of(replayed) / of_csv - 1;
    std::printf(
        "figure: inertia of the log over that of the CSV: %+.2g (torque in 0.1 %% of rated)\n",
        off);
    EXPECT_LT(std::abs(off), 1e-4);
    const Json bus = json_of(replayed).at("bus");
    EXPECT_EQ(bus.at("lost"), 0);
    EXPECT_EQ(bus.at("repeated"), 0);
    EXPECT_EQ(bus.at("late"), 0);
    EXPECT_LT(bus.at("jitter_s").get<double>(), 1e-6);
    EXPECT_EQ(bus.at("clock"), "SYNC");
}

TEST(Replay, AMapFileSaysTheSameAsTheProfile) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string log = simulated(folder, model, sine, "a.log");
    const std::string map = write(
        folder, "map.toml",
        "[bus]\nsync = 0x80\n[signals.position_count]\nid = 0x181\nstart_bit = 16\nlength = "
        "32\nsigned = true\n[signals.torque_ref_permille]\nid = 0x181\nstart_bit = 48\nlength = "
        "16\nsigned = true\n");
    const std::string profile = write(folder, "profile.toml",
                                      "[bus]\nprofile = \"cia402\"\nobjects = [\"6041\", \"6064\", "
                                      "\"6074\"]\n");
    const double one = inertia_of(run({"replay", log, "--map", map, "--model", model, "--json"}));
    EXPECT_EQ(one, inertia_of(run({"replay", log, "--map", profile, "--model", model, "--json"})));
    EXPECT_EQ(one, inertia_of(run({"identify", log, "--map", map, "--model", model, "--json"})));
}

TEST(Replay, ALogIsACaptureOfEveryVerb) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string log =
        simulated(folder, model, "trapezoid:stroke=6.28,velocity=40,cycles=4", "a.log");
    const std::string map = write(folder, "profile.toml",
                                  "[bus]\nprofile = \"cia402\"\nobjects = [\"6041\", \"6064\", "
                                  "\"6074\"]\n");
    const Json compared = json_of(run({"compare", model, log, "--map", map, "--json"}));
    EXPECT_LT(compared.at("torque_error").get<double>(), 0.03);
}

// candump any: the SYNC of another bus is none of this one.
TEST(Replay, AnotherBusIsLeftOut) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string log = simulated(folder, model, sine, "a.log");
    std::istringstream lines(text_of(log));
    std::string both;
    for (std::string line; std::getline(lines, line);) {
        both += line + "\n";
        if (const auto at = line.find("can0"); at != std::string::npos)
            both += line.replace(at, 4, "can1") + "\n";
    }
    const std::vector<std::string> options = {"--profile", "cia402",  "--objects", "6041",  "6064",
                                              "6074",      "--model", model,       "--json"};
    std::vector<std::string> one = {"replay", log}, two = {"replay", write(folder, "b.log", both)};
    one.insert(one.end(), options.begin(), options.end());
    two.insert(two.end(), options.begin(), options.end());
    EXPECT_EQ(inertia_of(run(one)), inertia_of(run(two)));
}

// Live needs a bus: the tests of label vcan. What can be said without one:
TEST(Replay, WithoutABusTheFaultIsNamed) {
    const std::vector<std::string> wrong[] = {
        {"replay", "--profile", "cia402"},                           // neither log nor bus
        {"replay", "a.log", "--can", "can0", "--profile", "cia402"}, // both
        {"replay", "a.log", "--for", "2", "--profile", "cia402"},    // what only a bus has
        {"replay", "--can", "can0", "--idle", "0", "--profile", "cia402"},
        {"replay", "a.log", "--period", "-1", "--profile", "cia402"}};
    for (const auto& words : wrong)
        EXPECT_EQ(run(words).code, 2) << words[1];
    const Ended ended = run({"replay", "--can", "nocan9", "--profile", "cia402", "--json"});
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_EQ(ended.out, "");
    const bool kernel = ended.err.find("this kernel has no CAN: `modprobe") != std::string::npos;
    const bool interface = ended.err.find("there is no such interface") != std::string::npos;
    EXPECT_TRUE(kernel || interface) << ended.err;
}

TEST(Replay, AStatedPeriodIsTaken) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string log = simulated(folder, model, sine, "a.log");
    std::vector<std::string> words = {"replay", log,    "--profile", "cia402", "--objects", "6041",
                                      "6064",   "6074", "--model",   model,    "--json"};
    const double found = inertia_of(run(words));
    words.insert(words.end(), {"--period", "125.0125e-6"}); // 1e-4 more: J goes with its square
    const Json stated = json_of(run(words));
    EXPECT_EQ(stated.at("bus").at("period_s"), 125.0125e-6);
    EXPECT_NEAR(stated.at("inertia").at("value").get<double>() / found, 1.0002, 2e-5);
}

TEST(Replay, WhatIsWrongIsSaidWithItsLine) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string log = simulated(folder, model, sine, "a.log");
    const auto expect = [&](const std::vector<std::string>& words, int code,
                            const std::string& said) {
        const Ended ended = run(words);
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
    };
    expect({"replay", log}, 2, "--map FILE, --dbc FILE, --profile NAME");
    expect({"replay", log, "--profile", "cia402", "--node", "9"}, 3, "0x189");
    const std::string torn = write(folder, "torn.log", "(1.0) can0 181#00\n(1.1) can0 18#0\n");
    expect({"replay", torn, "--profile", "cia402"}, 3, "torn.log:2: ");
    const std::string overlapping =
        write(folder, "overlap.toml",
              "[signals.position_count]\nid = 0x181\nstart_bit = 0\nlength = 32\n"
              "[signals.torque_permille]\nid = 0x181\nstart_bit = 16\nlength = 16\n");
    expect({"replay", log, "--map", overlapping}, 3, "share bits of frame 0x181");
    const std::string leaves = write(folder, "leaves.toml",
                                     "[signals.position_count]\nid = 0x181\nstart_bit = 500\n"
                                     "length = 32\n");
    expect({"replay", log, "--map", leaves}, 3, "leaves.toml:");
    const std::string column = write(folder, "column.toml", "[signals.torque]\ncolumn = \"t\"\n");
    expect({"replay", log, "--map", column}, 3, "column.toml:2: ");
}

// No model: the drive was asked for its scales while the log was written.
TEST(Replay, ScalesThatTheDriveWasAskedFor) {
    const Folder folder;
    const std::string log = simulated(folder, example("system1.toml"), sine, "a.log");
    const std::string text = text_of(log);
    const std::string start = "(0000000000.000000) can0 ";
    const auto replayed = [&](const std::string& answers) {
        return run({"replay", write(folder, "told.log", answers + text), "--profile", "cia402",
                    "--objects", "6041", "6064", "6074", "--json"});
    };
    EXPECT_NE(replayed("").code, 0);
    const std::string rated = start + "581#437660007D020000\n";    // 637 mN·m
    const std::string encoder = start + "581#438F600100000200\n" + // 131072 increments
                                start + "581#438F600201000000\n";  // a revolution
    const std::string model = text_of(example("system1.toml")); // whose friction is not taken out
    const std::string bare =
        write(folder, "bare.toml", model.substr(0, model.find("[effects.coulomb]")));
    const double with_model = inertia_of(run({"replay", log, "--profile", "cia402", "--objects",
                                              "6041", "6064", "6074", "--model", bare, "--json"}));
    EXPECT_NEAR(inertia_of(replayed(rated + encoder)) / with_model, 1, 1e-6);
    // Position units: 360 to a shaft revolution, two motor revolutions each, is twice the way of
    // a degree.
    const std::string feed = start + "581#4392600168010000\n" + start + "581#4392600201000000\n" +
                             start + "581#4391600102000000\n" + start + "581#4391600201000000\n";
    const double counts = 131072.0 / 360 * 2;
    EXPECT_NEAR(inertia_of(replayed(rated + feed)) / with_model, 1 / counts, 1e-6 / counts);
}
