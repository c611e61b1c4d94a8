// One thread that does one thing after the other, tells how far it is and can be stopped.
#pragma once

#include "diagnose/candidates.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace servoid::studio {

struct Busy {
    std::string what, detail;
    double share = 0, elapsed_s = 0;
    std::optional<double> left_s; // of the present pass, where the share says enough
};

class Worker {
  public:
    // What a piece of work gets: to be called now and then; throws where it should stop.
    using Work = std::function<void(const Progress&)>;

    // changed: called at the begin and end of each work, and ten times a second at most in between;
    // failed: with the message of what threw. Both from the worker's thread.
    Worker(std::function<void()> changed, std::function<void(const std::string&)> failed);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    // Throws UsageError where too much waits already. dispensable: ends when something else comes.
    void queue(const std::string& what, Work work, bool dispensable = false);
    void stop(); // what is being done, and what waits
    std::optional<Busy> busy() const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Task {
        std::string what;
        Work work;
        bool dispensable = false;
    };
    void run();
    void perform(const Task& task);
    void tell(const std::string& detail, double share);

    std::function<void()> changed_;
    std::function<void(const std::string&)> failed_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Task> waiting_;
    std::optional<Busy> busy_;
    bool dispensable_ = false; // what is being done
    Clock::time_point begun_, pass_, told_;
    std::atomic<bool> stop_{false}, ended_{false};
    std::thread thread_;
};

} // namespace servoid::studio
