#include "node/link.hpp"

#include "node/simulated_node.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace servoid {

namespace {

using std::chrono::milliseconds;
constexpr std::uint32_t kSync = 0x80;
constexpr int kDrained = 10000; // frames: a flood must not hold us up

std::string reason_of(std::uint32_t code) {
    static const std::map<std::uint32_t, std::string> known = {
        {SID_SDO_NO_OBJECT, "no such object"},
        {SID_SDO_NO_SUB, "no such sub-index"},
        {SID_SDO_LENGTH, "another length"},
        {SID_SDO_RANGE, "out of range"},
        {SID_SDO_READ_ONLY, "read only"},
        {SID_SDO_WRITE_ONLY, "write only"},
        {SID_SDO_STATE, "not now"},
        {SID_SDO_COMMAND, "no such transfer"}};
    const auto found = known.find(code);
    return found == known.end() ? "for a reason of its own" : found->second;
}

can::Frame sdo_frame(int node, std::uint8_t command, std::uint16_t index, std::uint8_t sub,
                     std::uint32_t value) {
    can::Frame out;
    out.id = can::request_id(node).id, out.length = 8;
    out.data[0] = command;
    out.data[1] = std::uint8_t(index & 0xFF), out.data[2] = std::uint8_t(index >> 8);
    out.data[3] = sub;
    for (std::size_t i = 0; i < 4; ++i)
        out.data[4 + i] = std::uint8_t(value >> (8 * i));
    return out;
}

bool same_object(const can::Frame& a, const can::Frame& b) {
    return std::equal(a.data.begin() + 1, a.data.begin() + 4, b.data.begin() + 1);
}

bool is_write(const can::Frame& request) { return (request.data[0] & 0xE0) == 0x20; }

// Of that kind and that object. A refusal fits both kinds.
bool answers(const can::Frame& answer, const can::Frame& request) {
    const int kind = answer.data[0] & 0xE0;
    return same_object(answer, request) &&
           (kind == 0x80 || kind == (is_write(request) ? 0x60 : 0x40));
}

std::uint32_t value_of(const can::Frame& frame) {
    std::uint32_t out = 0;
    for (std::size_t i = 8; i-- > 4;)
        out = out << 8 | frame.data[i];
    return out;
}

std::string name_of(const can::Frame& frame) {
    return fmt::format("object 0x{:02X}{:02X}:{}", frame.data[2], frame.data[1], frame.data[3]);
}

} // namespace

SdoAbort::SdoAbort(std::uint32_t code, const std::string& what)
    : BusError(fmt::format("{}: refused by the drive, {} (0x{:08X})", what, reason_of(code), code)),
      code_(code) {}

Link::Link(can::Bus& bus, const LinkOptions& options)
    : bus_(bus), options_(options), table_(options.node) {}

void Link::heartbeat(Clock::time_point now) {
    if (!beating_ || now < next_heartbeat_) return;
    can::Frame beat;
    beat.id = can::heartbeat_id(options_.master).id, beat.length = 1, beat.data[0] = 5;
    bus_.send(beat);
    next_heartbeat_ = now + milliseconds(options_.timeout_ms / 5);
}

void Link::take_answer(const can::Frame& frame) {
    if (asked_ && answers(frame, *asked_)) {
        answer_ = frame;
        asked_.reset();
        return;
    }
    ++report_.stray_answers;
    if (!foreign_ || !same_object(frame, *foreign_)) return;
    report_.foreign_changes += frame.data[0] == 0x60;
    foreign_.reset();
}

// Our own frames do not come back: these are somebody else's.
void Link::take_foreign(const can::Frame& frame) {
    const bool request = id_of(frame) == can::request_id(options_.node),
               references = id_of(frame) == can::references_id(options_.node),
               beat = id_of(frame) == can::heartbeat_id(options_.master);
    if (!request && !references && !beat) return;
    ++report_.foreign_requests;
    report_.foreign_changes += references;
    if (request && frame.length == 8 && is_write(frame)) foreign_ = frame;
}

void Link::take(const can::Frame& frame) {
    if (options_.heard) options_.heard(frame);
    table_.add(frame);
    if (frame.error || frame.remote || frame.extended) return;
    if (id_of(frame) == can::answer_id(options_.node) && frame.length == 8) take_answer(frame);
    if (id_of(frame) == can::heartbeat_id(options_.node) && frame.length >= 1) {
        ++beats_;
        if (frame.data[0] == 0) ++boots_;
    }
    take_foreign(frame);
}

bool Link::listen(Clock::time_point until, const std::function<bool()>& enough) {
    while (!enough()) {
        const auto now = Clock::now();
        if (now >= until) return false;
        can::Frame frame;
        heartbeat(now);
        if (bus_.receive(frame, std::min<std::chrono::nanoseconds>(until - now, milliseconds(20))))
            take(frame);
    }
    return true;
}

void Link::drain() {
    can::Frame frame;
    for (int i = 0; i < kDrained && bus_.receive(frame, std::chrono::nanoseconds(0)); ++i)
        take(frame);
}

// A request that the bus did not take counts as none: an interface that is down says so itself,
// when it has lasted (BusError).
std::uint32_t Link::request(const can::Frame& frame) {
    ++report_.requests;
    const long before = bus_.health().not_sent;
    const auto tries = [&] {
        return options_.tries + std::min(4L * options_.tries, bus_.health().not_sent - before);
    };
    for (int i = 0; i < tries(); ++i) {
        if (i > 0) ++report_.repeated_requests;
        asked_.reset();
        drain(); // answers to earlier requests, or to somebody else's
        answer_.reset();
        asked_ = frame;
        bus_.send(frame);
        if (!listen(Clock::now() + milliseconds(options_.answer_ms),
                    [&] { return answer_.has_value(); }))
            continue;
        if (answer_->data[0] == 0x80) throw SdoAbort(value_of(*answer_), name_of(frame));
        return value_of(*answer_);
    }
    asked_.reset();
    throw can::BusError(fmt::format("node {} does not answer ({}, {} times)", options_.node,
                                    name_of(frame), options_.tries));
}

std::uint32_t Link::read(std::uint16_t index, std::uint8_t sub) {
    return request(sdo_frame(options_.node, 0x40, index, sub, 0));
}

void Link::write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, int bytes) {
    request(sdo_frame(options_.node, std::uint8_t(0x23 | (4 - bytes) << 2), index, sub, value));
}

// The node's time stands still until the next SYNC: a lost one is sent again, soon, for one too
// many does no harm.
void Link::sync() {
    can::Frame frame;
    frame.id = kSync;
    for (int i = 0; i < 4 * options_.tries; ++i) {
        if (i > 0) ++report_.repeated_syncs;
        next_heartbeat_ = {}; // of its time we know no more than the SYNCs: a heartbeat for each
        heartbeat(Clock::now());
        const long before = beats_;
        bus_.send(frame);
        if (listen(Clock::now() + milliseconds(options_.answer_ms / 4),
                   [&] { return beats_ > before; }))
            return;
    }
    throw can::BusError(
        fmt::format("node {} does not answer SYNC: is it a free-running drive?", options_.node));
}

void Link::pump(milliseconds wait) {
    if (options_.cancelled()) throw can::BusError("stopped by the user");
    if (options_.free_running)
        sync();
    else
        listen(Clock::now() + wait, [] { return false; });
}

void Link::wait(double seconds) {
    if (!options_.free_running) return pump(milliseconds(std::lround(1e3 * seconds)));
    const auto& told = table_.description();
    const double each = kPeriodsPerSync * (told ? told->sample_time_s() : 125e-6);
    for (double t = 0; t < seconds; t += each)
        pump(milliseconds(0));
}

bool Link::tells_an_end() const {
    return table_.state() != SID_STATE_MEASURING && table_.state() != SID_STATE_STOPPING;
}

bool Link::was_reset() {
    const long seen = boots_ + table_.resets();
    return std::exchange(resets_seen_, seen) != seen;
}

} // namespace servoid
