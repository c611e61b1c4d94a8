#include "can/memory_bus.hpp"

#include "can/error_frame.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

namespace servoid::can {

namespace {

std::int64_t steady_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

struct MemoryBus::Wire {
    Clock clock;
    std::size_t queue_frames = 0;
    std::mutex mutex; // of everything here and of the ends' queues: one order for all
    std::vector<End*> ends;
};

class MemoryBus::End : public Bus {
  public:
    explicit End(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {
        const std::lock_guard lock(wire_->mutex);
        wire_->ends.push_back(this);
    }
    End(const End&) = delete;
    End& operator=(const End&) = delete;
    ~End() override {
        const std::lock_guard lock(wire_->mutex);
        std::erase(wire_->ends, this);
    }

    void send(const Frame& frame) override {
        const std::lock_guard lock(wire_->mutex);
        Frame sent = frame;
        sent.time_ns = wire_->clock();
        for (End* end : wire_->ends)
            if (end != this) end->put(sent);
        ++health_.sent;
    }

    bool receive(Frame& frame, std::chrono::nanoseconds wait) override {
        std::unique_lock lock(wire_->mutex);
        const bool any = came_.wait_for(lock, wait, [&] { return !queue_.empty(); });
        health_.dropped = dropped_; // others count it: the caller reads a copy
        if (!any) return false;
        frame = queue_.front();
        queue_.pop_front();
        ++health_.received;
        const Trouble trouble = trouble_of(frame);
        health_.error_frames += frame.error;
        health_.bus_off += trouble.bus_off;
        health_.restarted += trouble.restarted;
        health_.error_passive += trouble.error_passive;
        return true;
    }

    const BusHealth& health() const override { return health_; }

  private:
    void put(const Frame& frame) {
        if (queue_.size() >= wire_->queue_frames) {
            ++dropped_;
            return;
        }
        queue_.push_back(frame);
        came_.notify_one();
    }

    std::shared_ptr<Wire> wire_;
    std::deque<Frame> queue_;
    std::condition_variable came_;
    long dropped_ = 0;
    BusHealth health_;
};

MemoryBus::MemoryBus(Clock clock, std::size_t queue_frames) : wire_(std::make_shared<Wire>()) {
    wire_->clock = clock ? std::move(clock) : Clock(steady_ns);
    wire_->queue_frames = queue_frames;
}

std::unique_ptr<Bus> MemoryBus::end() { return std::make_unique<End>(wire_); }

} // namespace servoid::can
