// A CAN bus that can be listened to and talked on: SocketCAN, or a bus in memory for tests.
#pragma once

#include "can/frame.hpp"
#include "common/error.hpp"

#include <chrono>
#include <string>

namespace servoid::can {

// The bus or a drive on it fails: gone, off, silent, or not as it says.
class BusError : public Error {
  public:
    explicit BusError(const std::string& message) : Error(ExitCode::bus_fault, message) {}
};

// What the bus itself went through.
struct BusHealth {
    long received = 0, sent = 0;
    long dropped = 0;      // received, but there was no room left: never seen
    long not_sent = 0;     // given up because the bus took nothing for too long
    long error_frames = 0; // of them:
    long bus_off = 0, restarted = 0, error_passive = 0;
    long interface_down = 0;
};

class Bus {
  public:
    virtual ~Bus() = default;
    // Gives the frame to the bus; waits at most some tens of milliseconds for room, then counts it
    // as not_sent, and at once where the interface is down. Throws BusError where there is no bus
    // any more.
    virtual void send(const Frame& frame) = 0;
    // The next frame, error frames included; false where none came within `wait`. Frames come in
    // the order in which the bus carried them, and never the own ones.
    virtual bool receive(Frame& frame, std::chrono::nanoseconds wait) = 0;
    virtual const BusHealth& health() const = 0;
};

} // namespace servoid::can
