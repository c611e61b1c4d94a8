#include "can/record.hpp"

#include "can/candump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace servoid::can {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds kSlice{50}; // the user's wish to end is seen that often
constexpr std::size_t kTold = 16;               // identifiers in a message

double since(Clock::time_point start) { return Seconds(Clock::now() - start).count(); }

bool stopped(const RecordOptions& options) { return options.stop && *options.stop; }

template <class Ids> std::string list_of(const Ids& ids) {
    std::string out;
    std::size_t told = 0;
    for (FrameId id : ids) {
        if (told++ == kTold) return out + fmt::format(" and {} more", ids.size() - kTold);
        out += (out.empty() ? "" : ", ") + to_text(id);
    }
    return out.empty() ? "nothing" : out;
}

bool contains(const std::vector<FrameId>& ids, FrameId id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

} // namespace

Recorder::Recorder(const FrameMap& map, std::string interface, bool keep_log)
    : data_(data_identifiers(map)), mapped_(mapped_identifiers(map)),
      interface_(std::move(interface)), keep_log_(keep_log), table_(map) {}

void Recorder::run(Bus& bus, const RecordOptions& options) {
    const auto start = Clock::now();
    wait_for_first(bus, options);
    if (options.begun) options.begun();
    listen(bus, options);
    refuse_if_missing(since(start));
}

void Recorder::wait_for_first(Bus& bus, const RecordOptions& options) {
    const auto start = Clock::now();
    Frame frame;
    while (!stopped(options) && since(start) < options.wait_s)
        if (bus.receive(frame, kSlice) && keep(frame)) return;
    refuse_if_missing(since(start));
}

void Recorder::listen(Bus& bus, const RecordOptions& options) {
    const auto start = Clock::now();
    auto last = start; // data frame, or sign of trouble
    long troubles = 0;
    double patience_s = options.idle_s;
    Frame frame;
    while (!stopped(options) && (!options.for_s || since(start) < *options.for_s)) {
        if (bus.receive(frame, kSlice) && keep(frame)) {
            last = Clock::now(), patience_s = options.idle_s;
            continue;
        }
        // A bus that fails and comes back is no end of the move: the bus says when it is over.
        const long now = bus.health().interface_down + bus.health().bus_off;
        if (std::exchange(troubles, now) != now)
            last = Clock::now(), patience_s = options.idle_s + options.trouble_s;
        if (!options.for_s && since(last) >= patience_s) return;
    }
}

bool Recorder::keep(const Frame& frame) {
    const FrameId id = id_of(frame);
    if (!frame.error) {
        if (seen_.size() < 4096) seen_.insert(id);
        if (!contains(mapped_, id)) return false;
    }
    table_.add(frame);
    if (keep_log_) log_ += format_candump(frame, interface_) + "\n";
    return !frame.error && !frame.remote && contains(data_, id);
}

void Recorder::refuse_if_missing(double seconds) const {
    std::vector<FrameId> missing;
    for (FrameId id : mapped_)
        if (!seen_.contains(id)) missing.push_back(id);
    if (!missing.empty())
        throw BusError(fmt::format("{}: in {:.2g} s there came no frame {}; heard: {}", interface_,
                                   seconds, list_of(missing), list_of(seen_)));
}

} // namespace servoid::can
