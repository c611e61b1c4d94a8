// Logs of candump -l and -L: `(1436509052.249713) can0 181#0102` a line, `##` for FD.
#pragma once

#include "can/frame.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace servoid::can {

// Reads a text that is in memory line by line, without copies: some 10 million frames a second. The
// grammar is that of can-utils' parse_canframe(), CAN XL aside. Lines end with \n or \r\n; empty
// ones and `#` comments are passed over; frames that candump -d missed are counted in dropped().
// Anything else that is no frame is a FileError with its line.
class CandumpReader {
  public:
    // `text` must outlive the reader. path: for messages.
    CandumpReader(std::string_view text, std::string path);
    bool next(Frame& frame); // false at the end; the frame's content is then nobody's
    long line() const { return line_; }
    const std::vector<std::string>& interfaces() const { return interfaces_; }
    std::uint64_t dropped() const { return dropped_; }

    // The last line has no end: the logger was stopped while it wrote. That is no error. A line
    // that breaks off where no frame ends is passed over; one that may be whole is given, and may
    // have lost bytes.
    bool truncated() const { return truncated_; }

  private:
    bool next_line(std::string_view& line);
    bool read_line(std::string_view line, Frame& frame);
    std::uint8_t interface_index(std::string_view name);

    std::string_view rest_;
    std::string path_;
    long line_ = 0;
    bool truncated_ = false;
    std::uint64_t dropped_ = 0;
    std::vector<std::string> interfaces_;
};

// The same line, without its end, as candump -L writes it; 9 decimals where the time is no whole
// number of microseconds. Errors, remote and FD frames too. The time must not be negative.
std::string format_candump(const Frame& frame, const std::string& interface);

} // namespace servoid::can
