// Ctrl-C as a wish instead of an end.
#pragma once

#include <atomic>
#include <csignal>

namespace servoid::cli {

// While it lives, SIGINT and SIGTERM are noted and nothing else. One at a time.
class EndOnSignal {
  public:
    EndOnSignal();
    EndOnSignal(const EndOnSignal&) = delete;
    EndOnSignal& operator=(const EndOnSignal&) = delete;
    ~EndOnSignal();
    static const std::atomic<bool>& wanted();

  private:
    struct sigaction before_[2];
};

} // namespace servoid::cli
