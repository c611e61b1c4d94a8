#include "can/bus_table.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::can {

namespace {

constexpr long kShortest = 16; // rows of a table

bool holds(const std::optional<Field>& field, FrameId id) { return field && field->frame == id; }

// A second frame of a cycle whose forerunner is missing is that one, come late.
long pull_back_late(std::vector<long>& cycle) {
    long late = 0;
    for (std::size_t i = 0; i + 1 < cycle.size(); ++i) {
        const bool free = i == 0 || cycle[i - 1] < cycle[i] - 1;
        if (cycle[i] == cycle[i + 1] && free) --cycle[i], ++late;
    }
    return late;
}

// The drive's own times, s, in the order of arrival.
std::vector<double> device_times(const std::vector<std::int64_t>& ticks, const Field& field) {
    const std::vector<long> rolled = unrolled(ticks, field.length);
    std::vector<double> out;
    for (long tick : rolled)
        out.push_back(double(tick - rolled.front()) * field.scale);
    return out;
}

} // namespace

BusTable::BusTable(FrameMap map) : map_(std::move(map)) {
    const auto list = [&](const Field& field) -> Arrivals& {
        if (!find(field.frame)) arrivals_.emplace_back().id = field.frame;
        Arrivals& known = *find(field.frame);
        known.bytes = std::max(known.bytes, bytes_needed(field));
        return known;
    };
    for (std::size_t i = 0; i < map_.signals.size(); ++i)
        list(map_.signals[i].field).signals.push_back(i);
    if (map_.counter) list(*map_.counter);
    if (map_.device_time) list(*map_.device_time);
    for (Arrivals& a : arrivals_)
        a.values.resize(a.signals.size());
}

BusTable::Arrivals* BusTable::find(FrameId id) {
    for (Arrivals& a : arrivals_)
        if (a.id == id) return &a;
    return nullptr;
}

void BusTable::add(const Frame& frame) {
    if (seen_.frames++ == 0) first_ns_ = frame.time_ns;
    if (frame.error) count_error(frame, seen_);
    if (frame.error || frame.remote) return;
    const double time_s = double(frame.time_ns - first_ns_) * 1e-9;
    const FrameId id = id_of(frame);
    if (map_.sync && *map_.sync == id) sync_s_.push_back(time_s);
    Arrivals* a = find(id);
    if (!a) return;
    if (frame.length < a->bytes) {
        ++seen_.short_frames;
        return;
    }
    a->time_s.push_back(time_s);
    a->before.push_back(long(sync_s_.size()));
    if (holds(map_.counter, id)) a->counts.push_back(raw_of(*map_.counter, frame));
    if (holds(map_.device_time, id)) a->ticks.push_back(raw_of(*map_.device_time, frame));
    for (std::size_t i = 0; i < a->signals.size(); ++i)
        a->values[i].push_back(value_of(map_.signals[a->signals[i]].field, frame));
}

// Data follow the SYNC of their cycle.
// Whether arrivals tell nothing of the instants: who plays a log, or an adapter, pauses and then
// sends all that waited. Two SYNCs then seem to be one, though each has data of its own.
bool BusTable::comes_in_bursts(const FittedClock& clock) const {
    std::vector<bool> has_data(sync_s_.size() + 1, false); // after so many SYNCs
    for (long n : arrivals_.front().before)
        has_data[std::size_t(n)] = true;
    for (std::size_t i = 1; i < clock.cycle.size(); ++i)
        if (clock.cycle[i] <= clock.cycle[i - 1] && has_data[i] && has_data[i + 1]) return true;
    return false;
}

BusTable::Cycles BusTable::cycles_by_sync(BusReport& report, bool complete) const {
    FittedClock clock = fit_clock(sync_s_, map_.period_s);
    const bool counted = complete || comes_in_bursts(clock);
    if (counted) clock = counted_clock(sync_s_, map_.period_s);
    Cycles out(arrivals_.size());
    for (std::size_t a = 0; a < arrivals_.size(); ++a) {
        for (long n : arrivals_[a].before)
            out[a].push_back(n > 0 ? clock.cycle[std::size_t(n - 1)] : -1);
        report.late += pull_back_late(out[a]);
    }
    report.clock = counted ? "SYNC, counted" : "SYNC", report.period_s = clock.period_s,
    report.jitter_s = clock.jitter_s;
    return out;
}

// The clock of one identifier: what it carries itself, or when it arrives.
FittedClock BusTable::clock_of(const Arrivals& a, BusReport& report) const {
    if (!a.counts.empty()) {
        report.clock = "counter";
        return line_through(a.time_s, unrolled(a.counts, map_.counter->length));
    }
    if (a.ticks.empty()) {
        report.clock = "arrival";
        return fit_clock(a.time_s, map_.period_s);
    }
    report.clock = "device time";
    const FittedClock own = fit_clock(device_times(a.ticks, *map_.device_time), map_.period_s);
    report.period_s = own.period_s; // of the drive's clock, not of the log's
    return line_through(a.time_s, own.cycle);
}

// The number of the cycle of each arrival, for each identifier.
BusTable::Cycles BusTable::cycles(BusReport& report, bool complete) const {
    if (map_.sync) return cycles_by_sync(report, complete);
    std::size_t leader = 0; // by whose cycles the others are counted
    for (std::size_t a = 0; a < arrivals_.size(); ++a)
        if (!arrivals_[a].counts.empty() || !arrivals_[a].ticks.empty()) leader = a;
    const FittedClock base = clock_of(arrivals_[leader], report);
    if (!(report.period_s > 0)) report.period_s = map_.period_s.value_or(base.period_s);
    report.jitter_s = base.jitter_s;
    Cycles out(arrivals_.size());
    for (std::size_t a = 0; a < arrivals_.size(); ++a) {
        const auto& time_s = arrivals_[a].time_s;
        const FittedClock own = a == leader ? base : fit_clock(time_s, base.period_s);
        const long ahead = std::lround((own.start_s - base.start_s) / base.period_s);
        for (std::size_t i = 0; i < time_s.size(); ++i) {
            out[a].push_back(own.cycle[i] + ahead);
            report.late +=
                time_s[i] - own.start_s - double(own.cycle[i]) * base.period_s > base.period_s / 2;
        }
    }
    return out;
}

// Which arrival of each identifier stands in which cycle.
BusTable::Placed BusTable::place(BusReport& report, bool complete) const {
    const auto cycle = cycles(report, complete);
    Placed out;
    out.at.resize(arrivals_.size());
    for (std::size_t a = 0; a < arrivals_.size(); ++a) {
        auto& at = out.at[a];
        for (std::size_t i = 0; i < cycle[a].size(); ++i) {
            const long k = cycle[a][i];
            if (k < 0 && map_.sync) continue; // before the first SYNC
            const bool overtaken = !at.empty() && k < at.rbegin()->first;
            if (!at.emplace(k, i).second)
                ++report.repeated;
            else if (overtaken)
                ++report.reordered;
        }
        if (at.empty()) continue;
        out.first = a == 0 ? at.begin()->first : std::max(out.first, at.begin()->first);
        out.last = a == 0 ? at.rbegin()->first : std::min(out.last, at.rbegin()->first);
    }
    return out;
}

// The cycles from `first` on, up to `end`, as rows.
RawTable BusTable::table_of(const Placed& placed, long first, long end, double period_s) const {
    RawTable table;
    table.metadata_path = map_.path;
    for (const auto& [key, value] : map_.metadata)
        table.metadata[key] = {value, 0};
    RawColumn time{"time_s", *find_column("time_s"), {}, printed_as_double};
    for (long k = first; k < end; ++k)
        time.values.push_back(double(k - first) * period_s);
    table.columns.push_back(std::move(time));
    for (std::size_t a = 0; a < arrivals_.size(); ++a)
        for (std::size_t s = 0; s < arrivals_[a].signals.size(); ++s) {
            const MappedSignal& signal = map_.signals[arrivals_[a].signals[s]];
            const bool plain = signal.field.scale == 1 && signal.field.offset == 0;
            RawColumn column{
                signal.name, signal.meaning, {}, plain ? printed_as_integer : printed_as_double};
            for (long k = first; k < end; ++k)
                column.values.push_back(arrivals_[a].values[s][placed.at[a].at(k)]);
            table.columns.push_back(std::move(column));
        }
    return table;
}

// Those in which every identifier was received, in order. Only what was received is looked at: a
// clock that jumps by years skips more cycles than could be counted through.
std::vector<long> BusTable::whole_cycles(const Placed& placed) const {
    std::vector<long> out;
    for (const auto& [k, arrival] : placed.at.front())
        if (std::all_of(placed.at.begin(), placed.at.end(),
                        [k = k](const auto& frames) { return frames.contains(k); }))
            out.push_back(k);
    return out;
}

void BusTable::refuse_if_missing(const std::string& path) const {
    for (const Arrivals& a : arrivals_)
        if (a.time_s.empty())
            throw FileError(
                path, 0,
                fmt::format("no frame {} {}", to_text(a.id),
                            seen_.short_frames ? "is long enough for the map" : "is in the log"));
    if (map_.sync && sync_s_.empty())
        throw FileError(path, 0, "no SYNC frame " + to_text(*map_.sync) + " is in the log");
}

std::vector<RawTable> BusTable::tables(const std::string& path, BusReport& report,
                                       bool complete) const {
    report = seen_;
    refuse_if_missing(path);
    const Placed placed = place(report, complete);
    const std::vector<long> whole = whole_cycles(placed);
    std::vector<RawTable> out;
    for (std::size_t from = 0, to = 0; from < whole.size(); from = to) {
        while (to < whole.size() && whole[to] - whole[from] == long(to - from))
            ++to;
        if (long(to - from) < kShortest) continue;
        out.push_back(table_of(placed, whole[from], whole[to - 1] + 1, report.period_s));
        out.back().path = path;
        report.used += long(to - from) * long(arrivals_.size());
    }
    report.lost = placed.last - placed.first + 1 - long(whole.size());
    if (out.empty())
        throw Refusal(fmt::format("{}: no {} cycles in a row hold every signal", path, kShortest),
                      "a log of a bus that loses less");
    return out;
}

} // namespace servoid::can
