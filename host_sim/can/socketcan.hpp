// A CAN interface of this machine, through the kernel's SocketCAN.
#pragma once

#include "can/bus.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace servoid::can {

struct SocketCanOptions {
    std::vector<FrameId> listen_to;               // empty: every identifier
    int receive_buffer_bytes = 32 << 20;          // the kernel's; as much as it grants
    std::size_t queue_frames = 65536;             // behind it, in this program
    std::chrono::milliseconds send_wait{50};      // for room on a full bus
    std::chrono::milliseconds trouble_wait{2000}; // for an interface that is down, or bus off
};

// Classic frames and, where the interface carries them, FD; error frames too, whatever is listened
// to. Frame::time_ns is the kernel's time of arrival (its real-time clock, which may be set).
// One thread at a time.
//
// The constructor throws BusError where the kernel has no CAN, the interface is missing, is no CAN
// interface or is down, each with what to do. Later on an interface that is down, or a controller
// that is bus off, is waited for: what was received before it is given first, then receive() throws
// BusError when trouble_wait is over. Data that arrive, or a restart, end a bus off. An interface
// that is gone is a BusError at once.
// A signal ends receive() with false before its time, so that the caller can see why it came.
// BusHealth::dropped holds what the kernel and the queue here had no room for, and how often the
// controller says that it lost something.
class SocketCan : public Bus {
  public:
    explicit SocketCan(std::string interface, SocketCanOptions options = {});
    SocketCan(const SocketCan&) = delete;
    SocketCan& operator=(const SocketCan&) = delete;
    ~SocketCan() override;

    void send(const Frame& frame) override;
    bool receive(Frame& frame, std::chrono::nanoseconds wait) override;
    const BusHealth& health() const override { return health_; }

    // From now on; what is queued already stays. No frame is missed in between.
    void listen_to(const std::vector<FrameId>& identifiers);

  private:
    using Clock = std::chrono::steady_clock;
    struct Batch; // the kernel's structures
    void drain();
    int read_batch();
    void take(const Frame& frame);
    void note_trouble(const Frame& frame);
    void note_down();
    void count_kernel_drops();
    void refuse_lasting_trouble();
    bool wait_for_frames(std::chrono::nanoseconds wait) const;

    std::string interface_;
    SocketCanOptions options_;
    int socket_ = -1;
    std::unique_ptr<Batch> batch_;
    std::deque<Frame> queue_;
    int given_since_drain_ = 0;
    std::uint32_t kernel_drops_ = 0; // its counter, which rolls over
    std::optional<Clock::time_point> down_since_, off_since_;
    bool gone_ = false;
    BusHealth health_;
};

} // namespace servoid::can
