// Logs of candump in memory, and frames drawn at random, for the tests of their reader.
#pragma once

#include "can/candump.hpp"
#include "common/error.hpp"

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace servoid::can {

struct Log {
    std::vector<Frame> frames;
    std::vector<std::string> interfaces;
    std::uint64_t dropped = 0;
    bool truncated = false;
    long lines = 0;
};

inline Log read(std::string_view text) {
    CandumpReader reader(text, "drive.log");
    Log log;
    for (Frame frame; reader.next(frame);)
        log.frames.push_back(frame);
    log.interfaces = reader.interfaces();
    log.dropped = reader.dropped();
    log.truncated = reader.truncated();
    log.lines = reader.line();
    return log;
}

inline std::string message_of(std::string_view text) {
    try {
        read(text);
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

inline std::string line_of(const std::string& frame) {
    return "(1436509052.249713) can0 " + frame + "\n";
}

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}
    std::uint64_t below(std::uint64_t n) {
        return std::uniform_int_distribution<std::uint64_t>(0, n - 1)(random_);
    }
    bool one_in(std::uint64_t n) { return below(n) == 0; }

    Frame frame() {
        Frame f;
        f.time_ns = static_cast<std::int64_t>(below(9'223'372'036'000'000'000));
        if (one_in(2)) f.time_ns -= f.time_ns % 1000;
        const auto kind = below(4);
        f.error = kind == 0;
        f.remote = kind == 1;
        f.fd = kind == 2;
        f.extended = !f.error && one_in(2);
        f.id = static_cast<std::uint32_t>(below(f.error || f.extended ? 0x20000000 : 0x800));
        static constexpr std::uint8_t lengths[] = {0, 1,  2,  3,  4,  5,  6,  7,
                                                   8, 12, 16, 20, 24, 32, 48, 64};
        f.length = lengths[below(f.fd ? 16 : 9)];
        if (f.fd) f.fd_flags = static_cast<std::uint8_t>(below(16));
        f.interface = static_cast<std::uint8_t>(below(3));
        for (size_t i = 0; !f.remote && i < f.length; ++i)
            f.data[i] = static_cast<std::uint8_t>(below(256));
        return f;
    }

  private:
    std::mt19937_64 random_;
};

} // namespace servoid::can
