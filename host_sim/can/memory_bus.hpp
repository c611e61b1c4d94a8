// A bus within this program: for tests that need no kernel.
#pragma once

#include "can/bus.hpp"

#include <cstdint>
#include <functional>
#include <memory>

namespace servoid::can {

// Any number of ends, each a Bus. What one end sends all others receive, in one order for all of
// them, with the time of the clock at sending. Ends may live in different threads, one thread an
// end, and longer than the MemoryBus. Nothing is lost but what an end has no room for (dropped).
class MemoryBus {
  public:
    using Clock = std::function<std::int64_t()>; // ns; called by one end at a time

    // Without a clock: the steady one. queue_frames: of each end.
    explicit MemoryBus(Clock clock = {}, std::size_t queue_frames = 65536);
    std::unique_ptr<Bus> end();

  private:
    struct Wire;
    class End;
    std::shared_ptr<Wire> wire_;
};

} // namespace servoid::can
