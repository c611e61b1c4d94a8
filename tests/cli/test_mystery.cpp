// simulate --mystery and reveal: a secret that the file keeps and gives back.
#include "cli/run_program.hpp"

#include <algorithm>

using namespace servoid::cli_test;

namespace {

const std::string experiment = "trapezoid:stroke=12.56,velocity=50,cycles=4,torque_noise=1e-3";

Ended hide(const std::string& model, const std::string& seed, const std::string& out) {
    return run({"simulate", model, "--experiment", experiment, "--mystery", seed, "--seed", "5",
                "--out", out});
}

std::string rows_of(const std::string& capture) {
    const std::string text = text_of(capture);
    return text.substr(text.find("\ntime_s,"));
}

// The model's file with the tables of some effects taken out and one put in.
std::string with_effect(const Folder& folder, const Json& revealed) {
    std::string text = text_of(example("system1.toml"));
    for (const std::string name : revealed.at("replaces")) {
        const size_t from = text.find("[effects." + name + "]");
        if (from == std::string::npos) continue;
        text.erase(from, text.find("[effects.", from + 1) - from);
    }
    const std::string name = revealed.at("effect");
    const bool array = json_of(run({"effects", name, "--json"})).at("repeatable");
    text += array ? "\n[[effects." + name + "]]\n" : "\n[effects." + name + "]\n";
    for (const auto& [key, parameter] : revealed.at("parameters").items())
        text += key + " = " + parameter.at("value").dump() + "\n";
    std::ofstream(folder / "truth.toml") << text;
    return folder / "truth.toml";
}

TEST(Mystery, SameSeedSameFile) {
    const Folder folder;
    for (const char* name : {"a.csv", "b.csv"})
        ASSERT_EQ(hide(example("system1.toml"), "3", folder / name).code, 0);
    ASSERT_EQ(hide(example("system1.toml"), "4", folder / "c.csv").code, 0);
    EXPECT_EQ(text_of(folder / "a.csv"), text_of(folder / "b.csv"));
    EXPECT_NE(rows_of(folder / "a.csv"), rows_of(folder / "c.csv"));
}

TEST(Mystery, TheFileDoesNotNameIt) {
    const Folder folder;
    for (int seed = 1; seed <= 6; ++seed) {
        const std::string csv = folder / "a.csv";
        const Ended ended = hide(example("system1.toml"), std::to_string(seed), csv);
        ASSERT_EQ(ended.code, 0) << ended.err;
        const std::string effect = json_of(run({"reveal", csv, "--json"})).at("effect");
        EXPECT_EQ(text_of(csv).find(effect), std::string::npos) << effect;
        EXPECT_EQ((ended.out + ended.err).find(effect), std::string::npos) << effect;
        EXPECT_NE(text_of(csv).find("# mystery = " + std::to_string(seed) + "\n"),
                  std::string::npos);
    }
}

// The model with what reveal says gives the very same capture.
TEST(Mystery, RevealTellsTheTruth) {
    const Folder folder;
    for (const char* seed : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
        ASSERT_EQ(hide(example("system1.toml"), seed, folder / "a.csv").code, 0);
        const Json revealed = json_of(run({"reveal", folder / "a.csv", "--json"}));
        SCOPED_TRACE(revealed.at("effect").get<std::string>());
        ASSERT_EQ(run({"simulate", with_effect(folder, revealed), "--experiment", experiment,
                       "--seed", "5", "--out", folder / "b.csv"})
                      .code,
                  0);
        EXPECT_EQ(rows_of(folder / "a.csv"), rows_of(folder / "b.csv"));
    }
}

TEST(Mystery, RevealInWordsAndAsJson) {
    const Folder folder;
    ASSERT_EQ(hide(example("system1.toml"), "3", folder / "a.csv").code, 0);
    const Json json = json_of(run({"reveal", folder / "a.csv", "--json"}));
    EXPECT_EQ(json.at("schema"), "servoid.reveal/1");
    EXPECT_EQ(json.at("mystery"), 3);
    EXPECT_GE(json.at("torque_share"), 0.05);
    EXPECT_LE(json.at("torque_share"), 0.30);
    for (const auto& [key, parameter] : json.at("parameters").items()) {
        EXPECT_TRUE(parameter.at("value").is_number()) << key;
        EXPECT_TRUE(parameter.at("unit").is_string()) << key;
    }
    const Ended words = run({"reveal", folder / "a.csv"});
    EXPECT_EQ(words.code, 0);
    EXPECT_TRUE(words.out.starts_with(json.at("effect").get<std::string>())) << words.out;
    EXPECT_NE(words.out.find("% of the torque"), std::string::npos) << words.out;
}

TEST(Mystery, AnOrdinaryCaptureHidesNothing) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), "sine", "a.csv");
    const Ended ended = run({"reveal", csv, "--json"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find("a.csv: no mystery is hidden in this capture"), std::string::npos)
        << ended.err;
    EXPECT_EQ(run({"reveal", folder / "none.csv"}).code, 3);
}

TEST(Mystery, ADamagedSecretIsNamedWithItsLine) {
    const Folder folder;
    ASSERT_EQ(hide(example("system1.toml"), "3", folder / "a.csv").code, 0);
    std::string text = text_of(folder / "a.csv");
    text.replace(text.find("mystery_secret = ") + 17, 2, "%%");
    std::ofstream(folder / "a.csv") << text;
    const Ended ended = run({"reveal", folder / "a.csv"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("a.csv:2: mystery_secret is damaged"), std::string::npos) << ended.err;
}

TEST(Mystery, RefusedWhereNothingCouldBeSeen) {
    const Folder folder;
    const Ended ended =
        run({"simulate", example("system1.toml"), "--experiment",
             "sine:amplitude=1e-4,torque_noise=0.3", "--mystery", "1", "--out", folder / "a.csv"});
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_NE(ended.err.find("record instead: "), std::string::npos) << ended.err;
    EXPECT_TRUE(folder.files().empty());
}

// --- the picture of an effect -----------------------------------------------------------------

TEST(Picture, AsciiInAPipe) {
    const std::string out = run({"effects", "coulomb"}).out;
    const auto framed = std::count(out.begin(), out.end(), '|');
    EXPECT_GE(framed, 24) << out; // twelve rows between two bars, some points look like bars
    EXPECT_EQ(out.find("\xE2\xA0"), std::string::npos);
    EXPECT_NE(out.find("velocity, rad/s"), std::string::npos) << out;
}

TEST(Picture, BrailleOnATerminalThatSpeaksUtf8) {
    const auto typed = [](const std::string& locale) {
        const Folder folder;
        const std::string command =
            "env -u LC_ALL -u LC_CTYPE LANG=" + locale + " " + SERVOID_PROGRAM + " effects coulomb";
        const std::string script = "script -qec " + quoted(command) + " " +
                                   quoted(folder / "typed") + " >/dev/null </dev/null";
        EXPECT_EQ(std::system(script.c_str()), 0);
        return text_of(folder / "typed");
    };
    EXPECT_NE(typed("C.UTF-8").find("\xE2\xA0"), std::string::npos);
    EXPECT_EQ(typed("C").find("\xE2\xA0"), std::string::npos);
}

TEST(Picture, AsTwoArraysInJson) {
    const Json picture = json_of(run({"effects", "spring", "--json"})).at("picture");
    EXPECT_EQ(picture.at("x").size(), picture.at("y").size());
    EXPECT_GE(picture.at("x").size(), 50u);
    EXPECT_EQ(picture.at("x_name"), "position");
    EXPECT_EQ(picture.at("y_unit"), "N·m");
}

} // namespace
