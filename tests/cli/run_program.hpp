// The real program in a real shell: what it printed on each stream, and how it ended.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace servoid::cli_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Ended {
    int code = -1;
    std::string out, err;
};

inline std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A folder of one test's own, gone afterwards.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "servoid_test_XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::vector<std::string> files() const {
        std::vector<std::string> out;
        for (const auto& file : fs::directory_iterator(path_))
            out.push_back(file.path().filename());
        return out;
    }

  private:
    fs::path path_;
};

inline std::string quoted(const std::string& text) {
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

// `before` goes in front of the program: environment, or a limit.
inline Ended run(const std::vector<std::string>& arguments, const std::string& before = "") {
    const Folder folder;
    std::string command = before + (before.empty() ? "" : " ") + quoted(SERVOID_PROGRAM);
    for (const std::string& argument : arguments)
        command += " " + quoted(argument);
    command += " >" + quoted(folder / "out") + " 2>" + quoted(folder / "err") + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out"),
            text_of(folder / "err")};
}

// One JSON object on stdout and nothing else there.
inline Json json_of(const Ended& ended) {
    EXPECT_EQ(ended.code, 0) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << "not one JSON object: " << ended.out.substr(0, 300);
    return json.is_object() ? json : Json::object();
}

inline std::string example(const std::string& name) {
    return std::string(SERVOID_SOURCE_DIR) + "/examples/" + name;
}

// A simulated capture of the named model file.
inline std::string simulated(const Folder& folder, const std::string& model,
                             const std::string& experiment, const std::string& name) {
    const Ended ended =
        run({"simulate", model, "--experiment", experiment, "--out", folder / name});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return folder / name;
}

} // namespace servoid::cli_test
