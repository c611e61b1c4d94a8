// Every file of tests/cli/bad must be refused with the message its index asks for. The command
// line is tested with the same index.
#include "capture/capture.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"
#include "model/model.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <set>

using namespace servoid;

namespace {

const std::string folder = std::string(SERVOID_SOURCE_DIR) + "/tests/cli/bad/";

struct Entry {
    std::string file, kind, exit_code, message;
};

// Without it GoogleTest prints the bytes.
void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.file; }

std::vector<Entry> read_index() {
    std::vector<Entry> entries;
    for (const auto& line : split(read_file(folder + "expected.txt"), '\n')) {
        if (line.empty() || line[0] == '#') continue;
        const auto fields = split(line, '\t');
        EXPECT_EQ(fields.size(), 4u) << line;
        if (fields.size() == 4) entries.push_back({fields[0], fields[1], fields[2], fields[3]});
    }
    return entries;
}

void read(const Entry& entry) {
    const std::string path = folder + entry.file;
    if (entry.kind == "model")
        read_model(path);
    else if (entry.kind == "map")
        read_signal_map(path);
    else if (entry.kind == "capture") {
        const std::string map_path =
            std::filesystem::path(path).replace_extension(".map.toml").string();
        if (!std::filesystem::exists(map_path))
            read_capture(path);
        else {
            const SignalMap map = read_signal_map(map_path);
            read_capture(path, {}, &map);
        }
    } else
        throw std::logic_error("unknown kind " + entry.kind);
}

class BadFile : public testing::TestWithParam<Entry> {};

TEST_P(BadFile, IsRefusedWithItsReason) {
    const Entry& entry = GetParam();
    try {
        read(entry);
        ADD_FAILURE() << entry.file << " was accepted";
    } catch (const FileError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(std::regex_search(message, std::regex(entry.message)))
            << "said:     " << message << "\nexpected: " << entry.message;
        EXPECT_EQ(std::to_string(static_cast<int>(error.code())), entry.exit_code);
        EXPECT_EQ(message.find('\n'), std::string::npos) << "a message is one line: " << message;
        EXPECT_TRUE(is_utf8(message)) << message;
        EXPECT_LT(message.size(), 700u) << message;
    }
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadFile, testing::ValuesIn(read_index()),
                         [](const testing::TestParamInfo<Entry>& test) {
                             std::string name = test.param.file;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(BadCorpus, IndexAndFolderAgree) {
    std::set<std::string> listed = {"expected.txt", "make_mat_files.py"};
    for (const Entry& entry : read_index())
        listed.insert(entry.file);
    EXPECT_GE(listed.size(), 72u);
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        const std::string name = file.path().filename().string();
        if (name.ends_with(".map.toml")) continue;
        EXPECT_TRUE(listed.contains(name)) << name << " is not in the index";
    }
}

} // namespace
