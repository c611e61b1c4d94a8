// python-can (Debian's python3-can) reads the same logs as we do.
#include "can/candump.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

using namespace servoid;
using namespace servoid::can;

namespace {

class LogFile {
  public:
    explicit LogFile(const std::string& text) { write_file(path, text); }
    LogFile(const LogFile&) = delete;
    LogFile& operator=(const LogFile&) = delete;
    ~LogFile() { std::filesystem::remove(path); }

    const std::string path =
        (std::filesystem::temp_directory_path() / fmt::format("servoid_peer_{}.log", getpid()))
            .string();
};

// What the script says of a log. Debian's packages are for /usr/bin/python3, whichever comes first.
std::string python_can(const std::string& what, const LogFile& log) {
    const std::string command =
        fmt::format("/usr/bin/python3 '{}/tests/peer/read_candump.py' {} '{}'", SERVOID_SOURCE_DIR,
                    what, log.path);
    FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return "";
    std::string output;
    char part[4096];
    for (size_t n = 0; (n = std::fread(part, 1, sizeof part, pipe)) > 0;)
        output.append(part, n);
    EXPECT_EQ(::pclose(pipe), 0) << command;
    return output;
}

Frame random_frame(std::mt19937_64& random) {
    const auto below = [&](std::uint64_t n) { return random() % n; };
    static constexpr std::uint8_t lengths[] = {0, 1,  2,  3,  4,  5,  6,  7,
                                               8, 12, 16, 20, 24, 32, 48, 64};
    Frame frame;
    // python-can holds seconds as a double: half a microsecond fine in these years
    frame.time_ns = static_cast<std::int64_t>(below(2'000'000'000'000'000)) * 1000;
    frame.extended = below(2) != 0;
    frame.id = static_cast<std::uint32_t>(below(frame.extended ? 0x20000000 : 0x800));
    frame.remote = below(8) == 0;
    frame.fd = !frame.remote && below(2) != 0;
    frame.fd_flags = static_cast<std::uint8_t>(frame.fd ? below(4) : 0);
    frame.length = lengths[below(frame.fd ? 16 : 9)];
    for (size_t i = 0; !frame.remote && i < frame.length; ++i)
        frame.data[i] = static_cast<std::uint8_t>(below(256));
    return frame;
}

std::string random_log(unsigned seed, int frames) {
    std::mt19937_64 random(seed);
    std::string text;
    for (int i = 0; i < frames; ++i)
        text += format_candump(random_frame(random), i % 3 ? "can0" : "vcan1") + "\n";
    return text;
}

// As the script prints it.
std::string line_of(const Frame& frame, const std::string& interface) {
    std::string flags, data;
    if (frame.extended) flags += 'x';
    if (frame.remote) flags += 'r';
    if (frame.fd) flags += 'f';
    if (frame.fd_flags & 1) flags += 'b';
    if (frame.fd_flags & 2) flags += 'e';
    for (size_t i = 0; !frame.remote && i < frame.length; ++i)
        data += fmt::format("{:02x}", frame.data[i]);
    return fmt::format("{} {:x} {} {} {} {}\n", frame.time_ns / 1000, frame.id,
                       flags.empty() ? "-" : flags, frame.length, data.empty() ? "-" : data,
                       interface);
}

TEST(PythonCan, ReadsTheSameFrames) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = random_log(seed, 20000);
    CandumpReader reader(text, "peer.log");
    std::string ours;
    for (Frame frame; reader.next(frame);)
        ours += line_of(frame, reader.interfaces()[frame.interface]);
    const auto mine = split(ours, '\n'), theirs = split(python_can("list", LogFile(text)), '\n');
    ASSERT_EQ(mine.size(), theirs.size());
    for (size_t i = 0; i < mine.size(); ++i)
        ASSERT_EQ(mine[i], theirs[i]);
}

// One file, one run, one after the other. Judged by nobody but for the count.
TEST(PythonCan, SpeedBesideOurs) {
    const std::string text = random_log(1, 300'000);
    const LogFile log(text);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const std::string read = read_file(log.path);
    CandumpReader reader(read, log.path);
    long frames = 0;
    for (Frame frame; reader.next(frame);)
        ++frames;
    const double ours = std::chrono::duration<double>(Clock::now() - start).count();
    const auto theirs = split(python_can("time", log), ' ');
    ASSERT_EQ(theirs.size(), 2u);
    EXPECT_EQ(theirs[0], std::to_string(frames));
    const double rate = static_cast<double>(frames) / ours,
                 their_rate = static_cast<double>(frames) / parse_number(theirs[1]).value_or(0);
    fmt::print("figure: candump reader {:.3g} frames/s, python-can {:.3g} frames/s, ratio {:.0f}\n",
               rate, their_rate, rate / their_rate);
}

} // namespace
