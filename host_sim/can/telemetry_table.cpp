#include "can/telemetry_table.hpp"

#include "can/bus_clock.hpp"
#include "capture/assemble.hpp"
#include "common/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::can {

namespace {

constexpr std::int64_t kEpoch = std::int64_t(1) << 40; // between resets: beyond any 32-bit tick
constexpr std::int64_t kReset = 8000;                  // a step back by more is no reordering
constexpr std::size_t kShortest = 16;                  // rows of a capture
constexpr std::int64_t kTail = 400;                    // rows after a run: the axis comes to rest

// b - a of encoder words of so many bits, by the shorter way round.
std::int64_t difference(std::uint32_t b, std::uint32_t a, int bits) {
    const int unused = 32 - bits;
    return std::int32_t((b - a) << unused) >> unused;
}

RawColumn column(const char* name, Printing printing) {
    return {name, *find_column(name), {}, printing};
}

} // namespace

TelemetryTable::TelemetryTable(int node, std::map<std::string, std::string> metadata)
    : node_(node), metadata_(std::move(metadata)) {}

void TelemetryTable::begin_epoch() {
    if (fresh_) return; // two signs of one reset
    ++seen_.resets, fresh_ = true;
    epoch_ += kEpoch;
}

std::int64_t TelemetryTable::unroll(std::uint32_t tick) {
    if (!fresh_) {
        const std::int64_t step = std::int32_t(tick - std::uint32_t(last_tick_));
        if (step >= -kReset) return last_tick_ + step;
        begin_epoch();
    }
    fresh_ = false;
    return last_tick_ = epoch_ + tick;
}

void TelemetryTable::add_samples(const TelemetrySamples& samples, std::int64_t time_ns) {
    const std::int64_t tick = unroll(samples.tick);
    if (tick < newest_) ++seen_.reordered;
    for (int i = 0; i < samples.rows; ++i)
        all_.push_back({tick + i, samples.row[std::size_t(i)]});
    newest_ = std::max(newest_, tick);
    last_tick_ = std::max(last_tick_, tick);
    state_ = samples.state;
    arrival_s_.push_back(double(time_ns) * 1e-9);
    arrival_tick_.push_back(long(tick - epoch_));
}

void TelemetryTable::add_description(const TelemetryDescription& description) {
    const std::int64_t now = unroll(description.tick);
    const auto place = [&](std::uint32_t tick) {
        return now - std::int64_t(description.tick - tick);
    };
    const std::int64_t start = description.started() ? place(description.start_tick) : 0;
    description_ = description;
    if (runs_.empty() || runs_.back().start != start) runs_.push_back({start, 0, description});
    if (description.ended()) runs_.back().end = place(description.end_tick);
}

void TelemetryTable::add(const Frame& frame) {
    ++seen_.frames;
    if (frame.error) count_error(frame, seen_);
    if (frame.error || frame.remote || frame.extended) return;
    if (id_of(frame) == heartbeat_id(node_) && frame.length >= 1 && frame.data[0] == 0)
        begin_epoch();
    if (id_of(frame) != telemetry_id(node_)) return;
    const Telemetry told = decode_telemetry(frame);
    if (std::holds_alternative<std::monostate>(told)) ++seen_.short_frames;
    if (const auto* samples = std::get_if<TelemetrySamples>(&told))
        add_samples(*samples, frame.time_ns);
    if (const auto* description = std::get_if<TelemetryDescription>(&told))
        add_description(*description);
    if (const auto* progress = std::get_if<TelemetryProgress>(&told))
        progress_ = *progress, state_ = progress->state;
}

std::optional<double> TelemetryTable::position() const {
    if (!description_ || all_.empty()) return std::nullopt;
    const std::uint32_t raw = all_.back().row.position_raw;
    return description_->count *
           (description_->position_bits == 32 ? double(std::int32_t(raw)) : double(raw));
}

LiveRows TelemetryTable::newest(double span_s, std::size_t most) const {
    LiveRows out;
    if (!description_ || all_.empty()) return out;
    const TelemetryDescription& d = *description_;
    const auto count = std::min(all_.size(), std::size_t(span_s / d.sample_time_s()) + 1);
    const std::size_t first = all_.size() - count, every = count / most + 1;
    const std::int64_t start = runs_.empty() ? all_.front().tick : runs_.back().start;
    std::uint32_t before = all_[first].row.position_raw;
    std::int64_t at = d.position_bits == 32 ? std::int32_t(before) : std::int64_t(before);
    for (std::size_t i = first; i < all_.size(); i += every) {
        const TelemetryRow& row = all_[i].row;
        at += difference(row.position_raw, before, d.position_bits);
        before = row.position_raw;
        out.time_s.push_back(double(all_[i].tick - start) * d.sample_time_s());
        out.torque.push_back(d.rated_torque * std::ldexp(double(row.torque_pu_q20), -20));
        out.position.push_back(d.count * double(at));
    }
    return out;
}

std::vector<TelemetryTable::Row> TelemetryTable::sorted(BusReport& report) const {
    std::vector<Row> out = all_;
    std::stable_sort(out.begin(), out.end(),
                     [](const Row& a, const Row& b) { return a.tick < b.tick; });
    const auto same = [](const Row& a, const Row& b) { return a.tick == b.tick; };
    const auto end = std::unique(out.begin(), out.end(), same);
    report.repeated = long(out.end() - end);
    out.erase(end, out.end());
    for (std::size_t i = 1; i < out.size(); ++i)
        if (out[i].tick - out[i - 1].tick < kEpoch / 2)
            report.lost += long(out[i].tick - out[i - 1].tick - 1);
    return out;
}

// Rows without a gap of one run. A torque that was set one sample before belongs one row up.
Capture TelemetryTable::capture_of(const Row* first, const Row* end, const Run& run,
                                   const std::string& path) const {
    const TelemetryDescription& d = run.description;
    const bool last = d.torque_timing == SID_TORQUE_HELD_LAST;
    const char* torque_name =
        d.torque_timing == SID_TORQUE_SAMPLED ? "torque_permille" : "torque_ref_permille";
    RawColumn time = column("time_s", printed_as_double);
    RawColumn torque = column(torque_name, printed_as_double);
    RawColumn position = column("position_count", printed_as_integer);
    RawColumn reference = column("position_ref_count", printed_as_double);
    std::int64_t at = d.position_bits == 32 ? std::int32_t(first->row.position_raw)
                                            : std::int64_t(first->row.position_raw);
    // The axis is near its reference, however many turns it has made since the start.
    const std::int64_t asked =
        std::llround(std::ldexp(first->row.reference_q8, d.position_shift - 8));
    const std::int64_t start =
        at - asked +
        difference(d.start_raw + std::uint32_t(asked), first->row.position_raw, d.position_bits);
    for (const Row* r = first; r + last < end; ++r) {
        if (r != first)
            at += difference(r->row.position_raw, r[-1].row.position_raw, d.position_bits);
        time.values.push_back(double(r->tick - first->tick) * d.sample_time_s());
        torque.values.push_back(std::ldexp(1000.0 * r[last].row.torque_pu_q20, -20));
        position.values.push_back(double(at));
        reference.values.push_back(double(start) +
                                   std::ldexp(r->row.reference_q8, d.position_shift - 8));
    }
    RawTable table;
    table.path = table.metadata_path = path;
    table.metadata["source"] = {fmt::format("node {}, telemetry", node_), 0};
    for (const auto& [key, value] : metadata_)
        table.metadata[key] = {value, 0};
    table.columns = {std::move(time), std::move(torque), std::move(position)};
    if (d.started()) table.columns.push_back(std::move(reference));
    CaptureScales scales;
    scales.rated_torque = d.rated_torque, scales.position_per_count = d.count;
    scales.linear = d.linear;
    return assemble(std::move(table), scales);
}

double TelemetryTable::jitter_s() const {
    if (seen_.resets > 0 || arrival_s_.size() < 16) return 0;
    return line_through(arrival_s_, arrival_tick_).jitter_s;
}

// Rows without a gap of one run, long enough.
std::vector<TelemetryTable::Stretch> TelemetryTable::stretches(const std::vector<Row>& rows,
                                                               const std::vector<Run>& runs) {
    std::vector<Stretch> out;
    const bool any = runs.back().description.started();
    for (std::size_t from = 0, to = 0; from < rows.size(); from = to) {
        const auto next =
            std::upper_bound(runs.begin(), runs.end(), rows[from].tick,
                             [](std::int64_t t, const Run& r) { return t < r.start; });
        const Run& run = next == runs.begin() ? runs.front() : next[-1];
        to = from + 1;
        while (to < rows.size() && rows[to].tick == rows[to - 1].tick + 1 &&
               (next == runs.end() || rows[to].tick < next->start))
            ++to;
        const bool before = next == runs.begin() || !run.description.started();
        if (any && before) continue;
        std::size_t end = to;
        while (run.end > 0 && end > from && rows[end - 1].tick >= run.end + kTail)
            --end;
        if (end - from > kShortest) out.push_back({from, end, &run});
    }
    return out;
}

BusCaptures TelemetryTable::captures(const std::string& path) const {
    if (all_.empty())
        throw FileError(path, 0,
                        fmt::format("no telemetry {} of node {} is in it",
                                    to_text(telemetry_id(node_)), node_));
    if (!description_)
        throw FileError(path, 0,
                        fmt::format("node {} has not described itself (frame {}, kind 2): "
                                    "listen for a second of telemetry",
                                    node_, to_text(telemetry_id(node_))));
    BusCaptures out;
    out.report = seen_;
    out.report.clock = "device time", out.report.period_s = description_->sample_time_s();
    out.report.jitter_s = jitter_s();
    const std::vector<Row> rows = sorted(out.report);
    std::vector<Run> runs = runs_;
    std::stable_sort(runs.begin(), runs.end(),
                     [](const Run& a, const Run& b) { return a.start < b.start; });
    for (const Stretch& one : stretches(rows, runs)) {
        out.captures.push_back(
            capture_of(&rows[one.from], &rows[one.from] + (one.to - one.from), *one.run, path));
        out.report.used += long(one.to - one.from);
    }
    if (out.captures.empty())
        throw Refusal(fmt::format("{}: no {} samples in a row were received", path, kShortest),
                      "a log of a bus that loses less");
    return out;
}

} // namespace servoid::can
