// Logs of candump -l and -L: `(1436509052.249713) can0 181#0102` a line, `##` for FD.
#pragma once

#include "can/frame.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace servoid::can {

// Reads a text that is in memory line by line, without copies: some 10 million frames a second.
// Lines end with \n or \r\n; empty ones and `#` comments are passed over; anything else that is no
// frame is a FileError with its line. A last line that breaks off within a frame (the logger was
// stopped) is counted in truncated() and is no error.
class CandumpReader {
  public:
    // `text` must outlive the reader. path: for messages.
    CandumpReader(std::string_view text, std::string path);
    bool next(Frame& frame); // false at the end
    long line() const { return line_; }
    const std::vector<std::string>& interfaces() const { return interfaces_; }
    bool truncated() const { return truncated_; }

  private:
    std::string_view rest_;
    std::string path_;
    long line_ = 0;
    bool truncated_ = false;
    std::vector<std::string> interfaces_;
};

// The same line, without its end. Errors, remote and FD frames too.
std::string format_candump(const Frame& frame, const std::string& interface);

} // namespace servoid::can
