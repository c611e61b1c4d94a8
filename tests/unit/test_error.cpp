// Every error that a user sees ends with the exit code and the one line that scripts rely on.
#include "common/error.hpp"

#include <gtest/gtest.h>

namespace servoid {
namespace {

TEST(Error, a_wrong_file_names_file_line_and_reason) {
    const FileError error("run.csv", 12, "time goes back");
    EXPECT_EQ(error.code(), ExitCode::bad_file);
    EXPECT_STREQ(error.what(), "run.csv:12: time goes back");
}

TEST(Error, line_zero_means_the_whole_file) {
    EXPECT_STREQ(FileError("run.csv", 0, "cannot be read").what(), "run.csv: cannot be read");
}

TEST(Error, a_refusal_says_what_to_record_instead) {
    const Refusal refusal("the motion goes one way", "a move in both directions");
    EXPECT_EQ(refusal.code(), ExitCode::refused);
    EXPECT_EQ(refusal.record_instead(), "a move in both directions");
    EXPECT_STREQ(refusal.what(),
                 "the motion goes one way; record instead: a move in both directions");
}

TEST(Error, wrong_usage_is_caught_as_the_base_class) {
    try {
        throw UsageError("no such verb");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
    }
}

TEST(Error, exit_codes_are_the_documented_numbers) {
    EXPECT_EQ(int(ExitCode::done), 0);
    EXPECT_EQ(int(ExitCode::defect), 1);
    EXPECT_EQ(int(ExitCode::usage), 2);
    EXPECT_EQ(int(ExitCode::bad_file), 3);
    EXPECT_EQ(int(ExitCode::refused), 4);
    EXPECT_EQ(int(ExitCode::bus_fault), 5);
}

} // namespace
} // namespace servoid
