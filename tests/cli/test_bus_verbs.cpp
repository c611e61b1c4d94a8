// drive and command where there is no bus, or nothing that could be asked of one.
#include "cli/run_program.hpp"

using namespace servoid::cli_test;

namespace {

const std::string nowhere = "nocan7"; // an interface that no machine has

void expect(const std::vector<std::string>& arguments, int code, const std::string& said) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, code) << ended.err;
    EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
}

} // namespace

TEST(BusVerbs, WithoutABusTheyEndWithFive) {
    const std::string model = example("system1.toml");
    expect({"drive", model, "--can", nowhere}, 5, nowhere);
    expect({"command", "--can", nowhere, "status"}, 5, nowhere);
    expect({"command", "identify", "--amplitude", "1", "--can", nowhere, "--json"}, 5, nowhere);
}

TEST(BusVerbs, WrongUsageIsSaidBeforeTheBusIsAsked) {
    const std::string model = example("system1.toml");
    expect({"drive", model}, 2, "--can");
    expect({"command", "--can", nowhere}, 2, "subcommand");
    expect({"command", "status"}, 2, "--can");
    expect({"command", "--can", nowhere, "identify"}, 2, "--amplitude");
    expect({"command", "--can", nowhere, "identify", "--amplitude", "-1"}, 2, "--amplitude");
    expect({"command", "--can", nowhere, "move", "jump"}, 2, "jump");
    expect({"command", "--can", nowhere, "--node", "128", "status"}, 2, "--node");
    expect({"drive", model, "--can", nowhere, "--mystery", "1"}, 2, "--hidden-for");
    expect({"drive", "no.toml", "--can", nowhere}, 3, "no.toml");
    expect({"command", "--can", nowhere, "next", "no.toml", "a.csv"}, 3, "no.toml");
}
