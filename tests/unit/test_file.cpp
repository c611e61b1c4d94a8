#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace servoid;
namespace fs = std::filesystem;

namespace {

class Folder {
  public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "servoid_test_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::permissions(path_, fs::perms::owner_all, ignored);
        fs::remove_all(path_, ignored);
    }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    size_t entries() const {
        return static_cast<size_t>(
            std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

std::string error_of(const std::string& path, const std::string& content) {
    try {
        write_file(path, content);
        return "";
    } catch (const FileError& error) {
        return error.what();
    }
}

TEST(WriteFile, WritesAndReplacesWhole) {
    const Folder folder;
    const std::string path = folder / "out.csv";
    const std::string first(3'000'000, 'x');
    write_file(path, first);
    EXPECT_EQ(read_file(path), first);
    write_file(path, "short");
    EXPECT_EQ(read_file(path), "short");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFile, KeepsBytesAsTheyAre) {
    const Folder folder;
    std::string all;
    for (int c = 0; c < 256; ++c)
        all += static_cast<char>(c);
    write_file(folder / "bytes", all);
    EXPECT_EQ(read_file(folder / "bytes"), all);
}

TEST(WriteFile, NewFileHasTheUsualPermissionsAndAnOldOneKeepsIts) {
    const Folder folder;
    const std::string path = folder / "out";
    const mode_t mask = ::umask(022);
    write_file(path, "a");
    ::umask(mask);
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0644u);
    ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
    write_file(path, "b");
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);
}

TEST(WriteFile, WritesThroughALink) {
    const Folder folder;
    write_file(folder / "real", "old");
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "real"), "new");
}

TEST(WriteFile, RefusesAFolderAndAMissingFolder) {
    const Folder folder;
    EXPECT_NE(error_of(folder.path().string(), "x").find("it is a folder"), std::string::npos);
    EXPECT_NE(error_of(folder / "missing/out", "x").find("No such file"), std::string::npos);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteFile, RefusesAnUnwritableFolder) {
    if (::geteuid() == 0) {
        // Root writes anywhere but here.
        EXPECT_NE(error_of("/proc/servoid_out", "x"), "");
        return;
    }
    const Folder folder;
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_NE(error_of(folder / "out", "x").find("Permission denied"), std::string::npos);
}

// A file size limit is what a full disk looks like: the write stops half way.
TEST(WriteFile, FullDiskLeavesTheOldFileAndNothingElse) {
    const Folder folder;
    const std::string path = folder / "out";
    write_file(path, "old");
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    rlimit limit = old_limit;
    limit.rlim_cur = 4096;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    const std::string error = error_of(path, std::string(100'000, 'x'));
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_NE(error.find("cannot be written: File too large"), std::string::npos) << error;
    EXPECT_EQ(read_file(path), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFile, FullDeviceIsAnError) {
    EXPECT_NE(error_of("/dev/full", "x").find("No space left"), std::string::npos);
    EXPECT_EQ(error_of("/dev/null", "x"), "");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(ReadFile, SaysWhyNot) {
    const Folder folder;
    EXPECT_THROW(read_file(folder / "missing"), FileError);
    EXPECT_THROW(read_file(folder.path().string()), FileError);
    std::ofstream(folder / "huge");
    fs::resize_file(folder / "huge", (std::uintmax_t{2} << 30) + 1);
    EXPECT_THROW(read_file(folder / "huge"), FileError);
    write_file(folder / "empty", "");
    EXPECT_EQ(read_file(folder / "empty"), "");
}

TEST(Text, ClosestNameFindsSlipsAndNothingElse) {
    const std::vector<std::string> names = {"viscous", "coulomb", "constant_torque"};
    EXPECT_EQ(closest_name("viscos", names), "viscous");
    EXPECT_EQ(closest_name("Coulomb", names), "coulomb");
    EXPECT_EQ(closest_name("banana", names), "");
    EXPECT_EQ(closest_name(std::string(1'000'000, 'v'), names), "");
}

TEST(Text, NumbersAreStrict) {
    EXPECT_EQ(parse_number(" +1.5e-3 "), 1.5e-3);
    for (const auto* wrong :
         {"", " ", "nan", "inf", "0x10", "1,5", "1 2", "--1", "+-1", "1e", "1e999"})
        EXPECT_FALSE(parse_number(wrong)) << wrong;
}

TEST(Text, QuotedIsAlwaysPrintable) {
    EXPECT_EQ(in_quotes("a\tb"), "\"a?b\"");
    EXPECT_EQ(in_quotes("\xff"), "\"?\"");
    // Cutting inside a character must not leave half of it.
    const std::string shown = in_quotes(std::string(39, 'a') + "\xc3\xa4\xc3\xa4");
    EXPECT_TRUE(is_utf8(shown)) << shown;
}

TEST(Text, Utf8) {
    EXPECT_TRUE(is_utf8("N\xc2\xb7m \xe2\x82\xac \xf0\x9f\x98\x80"));
    for (const auto* wrong :
         {"\xff", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xc2", "\x80"})
        EXPECT_FALSE(is_utf8(wrong));
}

} // namespace
