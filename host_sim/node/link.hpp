// A master's link to one node: its objects, its telemetry, and the heartbeat that keeps it going.
#pragma once

#include "can/bus.hpp"
#include "can/telemetry_table.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace servoid {

struct LinkOptions {
    int node = 1, master = 127;
    int timeout_ms = 500; // without our heartbeat the drive holds its axis
    int answer_ms = 200;  // for an answer; then the request is sent again
    int tries = 5;
    bool free_running = false; // the drive's time passes with our SYNC
    std::function<bool()> cancelled = [] { return false; };
    std::function<void(const can::Frame&)> heard; // every frame that comes; may be empty
};

// The drive's answer to a request: no.
class SdoAbort : public can::BusError {
  public:
    SdoAbort(std::uint32_t code, const std::string& what);
    std::uint32_t code() const { return code_; }

  private:
    std::uint32_t code_;
};
constexpr std::uint32_t kNotNow = 0x08000022;

// What went wrong on the way, and was mended.
struct LinkReport {
    long requests = 0, repeated_requests = 0;
    long stray_answers = 0;    // to what we did not ask
    long foreign_requests = 0; // somebody else talks to our node: a second master
    long foreign_changes = 0;  // of them: references, and writes that the node has taken
    long repeated_syncs = 0;
};

class Link {
  public:
    using Clock = std::chrono::steady_clock;
    Link(can::Bus& bus, const LinkOptions& options);

    // An object of up to four bytes. Asked again where no answer comes; throws BusError when the
    // node stays silent, SdoAbort when it refuses.
    std::uint32_t read(std::uint16_t index, std::uint8_t sub);
    void write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, int bytes);

    // From now on the heartbeat goes out. Only who owns the node sends it: another one's heartbeat
    // would keep a run going whose master is gone.
    void begin_heartbeat() { beating_ = true; }
    // Listens, for `wait` of the machine's time, or for one SYNC of a free-running drive; sends
    // the heartbeat when it is due.
    void pump(std::chrono::milliseconds wait);
    // So much of the drive's time, about.
    void wait(double seconds);
    void send(const can::Frame& frame) { bus_.send(frame); }

    const can::TelemetryTable& telemetry() const { return table_; }
    // What came until now is of no interest any more.
    void forget_telemetry() { table_ = can::TelemetryTable(options_.node); }
    // The node has booted, or its time has begun anew, since the last call.
    bool was_reset();
    // The newest telemetry says that nothing runs. A hint: it may be from before a start.
    bool tells_an_end() const;
    const LinkReport& report() const { return report_; }
    const LinkOptions& options() const { return options_; }
    const can::Bus& bus() const { return bus_; }

  private:
    void heartbeat(Clock::time_point now);
    void sync();
    void take(const can::Frame& frame);
    void drain();
    void take_answer(const can::Frame& frame);
    void take_foreign(const can::Frame& frame);
    bool listen(Clock::time_point until, const std::function<bool()>& enough);
    std::uint32_t request(const can::Frame& frame);

    can::Bus& bus_;
    LinkOptions options_;
    can::TelemetryTable table_;
    LinkReport report_;
    bool beating_ = false;
    Clock::time_point next_heartbeat_{};
    std::optional<can::Frame> asked_, answer_; // the request that is open, and its answer
    std::optional<can::Frame> foreign_;        // the last write of somebody else
    long beats_ = 0, boots_ = 0;               // of the node
    long resets_seen_ = 0;
};

} // namespace servoid
