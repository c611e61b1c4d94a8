// What every verb has: help with examples, one JSON object, quiet, no colour in a pipe, exit codes.
#include "cli/run_program.hpp"

#include <algorithm>

using namespace servoid::cli_test;

namespace {

const std::vector<std::string> verbs = {"simulate", "identify", "sweep",   "friction",
                                        "compare",  "add",      "effects", "reveal"};

TEST(EveryVerb, HasHelpWithExamples) {
    for (const std::string& verb : verbs) {
        SCOPED_TRACE(verb);
        const Ended ended = run({verb, "--help"});
        EXPECT_EQ(ended.code, 0);
        EXPECT_EQ(ended.err, "");
        const auto examples = ended.out.find("Examples:");
        ASSERT_NE(examples, std::string::npos);
        EXPECT_NE(ended.out.find("  servoid " + verb, examples), std::string::npos);
        for (const char* option : {"--json", "--quiet"})
            EXPECT_NE(ended.out.find(option), std::string::npos) << option;
    }
}

TEST(EveryVerb, IsInTheProgramsHelp) {
    const Ended ended = run({"--help"});
    EXPECT_EQ(ended.code, 0);
    for (const std::string& verb : verbs)
        EXPECT_NE(ended.out.find("\n  " + verb), std::string::npos) << verb;
}

TEST(Usage, WrongUsageEndsWith2) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"identfy"},
        {"sweep"},
        {"sweep", model, "--from", "-1"},
        {"sweep", model, "--from", "ten"},
        {"sweep", model, "--from", "200", "--to", "10"},
        {"sweep", model, "--no-such-option"},
        {"sweep", model, "--method", "fourier"},
        {"effects", "witchcraft"},
        {"simulate", model, "--experiment", "sine"},
        {"simulate", model, "--experiment", "sin", "--out", folder / "a.csv"},
        {"simulate", model, "--experiment", "sine:frequency=1", "--out", folder / "a.csv"},
        {"simulate", model, "--experiment", "sine:frequency_Hz=0", "--out", folder / "a.csv"},
    };
    for (const auto& command : wrong) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 2) << (command.empty() ? "nothing" : command.back()) << ended.err;
        EXPECT_NE(ended.err, "");
        EXPECT_EQ(ended.out, "");
    }
    EXPECT_TRUE(folder.files().empty());
}

TEST(Usage, EffectThatCannotStandInTheModel) {
    const Folder folder;
    const std::string csv =
        simulated(folder, example("system1.toml"), "trapezoid:cycles=2", "a.csv");
    for (const char* effect : {"viscous", "witchcraft"}) {
        const Ended ended = run({"add", effect, example("system1.toml"), csv});
        EXPECT_EQ(ended.code, 2) << effect;
        EXPECT_TRUE(ended.err.starts_with("servoid: ")) << ended.err;
    }
}

TEST(Program, SaysItsVersion) {
    const Ended ended = run({"--version"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '.'), 2) << ended.out;
}

// Under a terminal colour is on, unless NO_COLOR says otherwise; in a pipe it is off. `script`
// lends the program a terminal.
std::string on_a_terminal(const std::string& environment) {
    const Folder folder;
    const std::string command = environment + " " + SERVOID_PROGRAM + " effects coulomb";
    const std::string script = "script -qec " + quoted(command) + " " + quoted(folder / "typed") +
                               " >/dev/null </dev/null";
    EXPECT_EQ(std::system(script.c_str()), 0);
    return text_of(folder / "typed");
}

TEST(Colour, OnlyOnATerminalAndNotAgainstNoColor) {
    EXPECT_EQ(run({"effects", "coulomb"}).out.find('\033'), std::string::npos);
    EXPECT_NE(on_a_terminal("env -u NO_COLOR").find("\033[1m"), std::string::npos);
    EXPECT_EQ(on_a_terminal("env NO_COLOR=1").find("\033["), std::string::npos);
}

TEST(Quiet, SaysNothing) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), "sine", "a.csv");
    for (const auto& command :
         {std::vector<std::string>{"identify", csv, "--quiet"},
          std::vector<std::string>{"sweep", example("system1.toml"), "--to", "20", "--quiet"},
          std::vector<std::string>{"effects", "--quiet"}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 0);
        EXPECT_EQ(ended.out + ended.err, "");
    }
}

} // namespace
