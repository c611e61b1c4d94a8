// Output files are written whole or not at all.
#include "cli/run_program.hpp"

using namespace servoid::cli_test;

namespace {

const std::string sine = "sine:frequency_Hz=100";

TEST(OutputFile, MissingFolderIsSaidAndNothingIsLeft) {
    const Folder folder;
    const Ended ended = run({"simulate", example("system1.toml"), "--experiment", sine, "--out",
                             folder / "no/such/run.csv"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_TRUE(ended.err.starts_with("servoid: ")) << ended.err;
    EXPECT_NE(ended.err.find("run.csv"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_TRUE(folder.files().empty());
}

TEST(OutputFile, FolderInsteadOfAFile) {
    const Folder folder;
    fs::create_directory(folder / "run.csv");
    const Ended ended = run(
        {"simulate", example("system1.toml"), "--experiment", sine, "--out", folder / "run.csv"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(folder.files(), std::vector<std::string>{"run.csv"});
    EXPECT_TRUE(fs::is_empty(folder / "run.csv"));
}

// The kernel stops the program's writing after 8 blocks: what was there before is still there.
TEST(OutputFile, ADiskThatFillsUpLeavesTheOldFile) {
    const Folder folder;
    std::ofstream(folder / "run.csv") << "old\n";
    const Ended ended = run(
        {"simulate", example("system1.toml"), "--experiment", sine, "--out", folder / "run.csv"},
        "trap '' XFSZ; ulimit -f 8;");
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_EQ(text_of(folder / "run.csv"), "old\n");
    EXPECT_EQ(folder.files().size(), 1u);
}

TEST(OutputFile, AddThatIsRefusedWritesNothing) {
    const Folder folder;
    const std::string run_csv =
        simulated(folder, example("system1.toml"), "constant_speed:velocity=20", "run.csv");
    std::ofstream(folder / "old.toml") << "old\n";
    const Ended ended = run(
        {"add", "constant_torque", example("system1.toml"), run_csv, "--out", folder / "old.toml"});
    EXPECT_EQ(ended.code, 4) << ended.out << ended.err;
    EXPECT_EQ(text_of(folder / "old.toml"), "old\n");
    EXPECT_EQ(folder.files().size(), 2u);
}

TEST(OutputFile, MinusIsStdout) {
    const Ended ended =
        run({"simulate", example("system1.toml"), "--experiment", sine, "--out", "-"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.out.find("time_s,"), std::string::npos);
    EXPECT_EQ(ended.err, "");
}

} // namespace
