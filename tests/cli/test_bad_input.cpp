// Every file of bad/ through the real program: exit code, one line on stderr that says what is
// wrong, nothing on stdout, no file left behind.
#include "cli/run_program.hpp"

#include <algorithm>
#include <regex>

using namespace servoid::cli_test;

namespace {

const std::string bad = std::string(SERVOID_SOURCE_DIR) + "/tests/cli/bad/";

struct Entry {
    std::string file, kind, code, message;
};

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.file; }

std::vector<Entry> entries() {
    std::vector<Entry> out;
    std::istringstream index(text_of(bad + "expected.txt"));
    for (std::string line; std::getline(index, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream fields(line);
        Entry e;
        std::getline(fields, e.file, '\t'), std::getline(fields, e.kind, '\t');
        std::getline(fields, e.code, '\t'), std::getline(fields, e.message);
        out.push_back(e);
    }
    return out;
}

// A model that lends a capture no scales.
std::string bare_model(const Folder& folder) {
    std::ofstream(folder / "bare.toml")
        << "name = \"bare\"\nmotion = \"rotary\"\n[plant]\ninertia = 1e-5\n";
    return folder / "bare.toml";
}

// `add` reads a model and a capture and writes a file: the longest way a bad file can get.
std::vector<std::string> command_for(const Entry& e, const std::string& bare,
                                     const std::string& out) {
    const std::string model = e.kind == "model" ? bad + e.file : bare;
    const std::string file = e.kind == "capture" ? bad + e.file : bare;
    std::vector<std::string> command = {"add", "constant_torque", model, file, "--out", out};
    const std::string map = fs::path(file).replace_extension(".map.toml");
    if (e.kind == "map")
        command.insert(command.end(), {"--map", bad + e.file});
    else if (e.kind == "capture" && fs::exists(map))
        command.insert(command.end(), {"--map", map});
    return command;
}

class BadInput : public testing::TestWithParam<Entry> {};

TEST_P(BadInput, EndsAsTheIndexSays) {
    const Entry& e = GetParam();
    const Folder inputs, folder;
    const Ended ended = run(command_for(e, bare_model(inputs), folder / "model.toml"));
    EXPECT_EQ(std::to_string(ended.code), e.code) << ended.err;
    EXPECT_TRUE(ended.err.starts_with("servoid: ")) << ended.err;
    EXPECT_TRUE(std::regex_search(ended.err, std::regex(e.message)))
        << "said:     " << ended.err << "expected: " << e.message;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_TRUE(folder.files().empty());
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadInput, testing::ValuesIn(entries()),
                         [](const testing::TestParamInfo<Entry>& test) {
                             std::string name = test.param.file;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

// The verbs that read captures say the same of the same file.
TEST(BadInputOfEachVerb, SaysTheSame) {
    const std::string file = bad + "nan.csv", model = example("system1.toml");
    const std::vector<std::vector<std::string>> commands = {{"identify", file},
                                                            {"identify", file, "--json"},
                                                            {"friction", file},
                                                            {"compare", model, file},
                                                            {"compare", model, file, "--json"},
                                                            {"add", "viscous", model, file}};
    for (const auto& command : commands) {
        SCOPED_TRACE(command[0]);
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 3);
        EXPECT_NE(ended.err.find("nan.csv:6: column \"position_rad\""), std::string::npos)
            << ended.err;
        EXPECT_EQ(ended.out, "");
    }
}

TEST(BadInputOfEachVerb, ModelIsReadBeforeAnythingIsDone) {
    const std::string model = bad + "negative_inertia.toml";
    const Folder folder;
    for (const auto& command : {std::vector<std::string>{"simulate", model, "--experiment", "sine",
                                                         "--out", folder / "run.csv"},
                                std::vector<std::string>{"sweep", model}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 3);
        EXPECT_NE(ended.err.find("negative_inertia.toml:5: plant.inertia"), std::string::npos)
            << ended.err;
    }
    EXPECT_TRUE(folder.files().empty());
}

} // namespace
