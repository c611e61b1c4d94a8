#include "node/master.hpp"

#include "common/scaled.hpp"
#include "servoid/sid_sdo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace servoid {

namespace {

using std::chrono::milliseconds;

constexpr std::uint16_t kAxis = 0x2A00, kCommand = 0x2A01, kStatus = 0x2A02, kOptions = 0x2A03,
                        kLimits = 0x2A04, kFrequency = 0x2A05, kAmplitude = 0x2A06,
                        kResult = 0x2A10;
constexpr int kVersion = 1;
constexpr auto kStalled = std::chrono::seconds(2); // nothing goes on for so long: a fault
constexpr auto kAsk = milliseconds(20);            // a move that gets no further is asked for
constexpr auto kLook = milliseconds(500);          // between two looks at a run's state,
constexpr auto kSilence = milliseconds(100);       // or after so long without telemetry
constexpr std::uint32_t kReferencesInFrame = 14;
// On the way to the drive at once: a quarter of a second at 8 kHz, for answers that take so long.
constexpr std::uint32_t kInFlight = 146 * kReferencesInFrame;

std::uint32_t token() {
    std::random_device random;
    return std::max<std::uint32_t>(1, std::uint32_t(random()));
}

std::uint32_t q8(double periods) { return std::uint32_t(std::lround(periods * 256)); }

can::Frame reference_frame(int node, const std::vector<std::int32_t>& references,
                           std::uint32_t first, std::uint32_t count) {
    can::Frame out;
    out.id = can::references_id(node).id, out.fd = true, out.fd_flags = 1, out.length = 64;
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i)
            out.data[at + i] = std::uint8_t(value >> (8 * i));
    };
    out.data[0] = 1, out.data[1] = std::uint8_t(count);
    put(4, first);
    for (std::uint32_t i = 0; i < count; ++i)
        put(8 + 4 * i, std::uint32_t(references[first + i]));
    return out;
}

std::vector<std::int32_t> references_of(const Experiment& e, const DriveScales& s) {
    const double unit = s.count * std::ldexp(1, s.position_shift - 8);
    const double zero = e.position_ref(0);
    std::vector<std::int32_t> out;
    const long rows = std::lround(e.duration_s / s.sample_time_s);
    for (long i = 0; i < rows; ++i) {
        const double r = std::round((e.position_ref(double(i) * s.sample_time_s) - zero) / unit);
        if (std::fabs(r) > 2147483647.0)
            throw UsageError("the move goes further than the drive's reference can say");
        out.push_back(std::int32_t(r));
    }
    return out;
}

} // namespace

bool is_refusal(sid_reason_t reason) {
    return reason >= SID_NO_EXCITATION && reason <= SID_NOT_A_SINE;
}

Master::Master(Link& link) : link_(link), token_(token()), run_(token()) {
    read_scales();
    claim();
    link_.begin_heartbeat();
    link_.write(
        0x1016, 1,
        std::uint32_t(link_.options().master) << 16 | std::uint32_t(link_.options().timeout_ms), 4);
    link_.write(kCommand, 6, 1, 1);
    (void)link_.was_reset(); // it may have been switched on just now
}

Master::~Master() {
    if (!claimed_) return;
    try {
        if (link_.read(kCommand, 1) != token_) return; // what runs there is another master's
        link_.write(kCommand, 5, 1, 1);
        link_.write(kCommand, 6, 0, 1);
        link_.write(kCommand, 1, 0, 4);
    } catch (const Error&) { // its heartbeat will be missed, and the drive holds its axis
    }
}

double Master::read_scaled(std::uint16_t index, std::uint8_t sub) {
    const auto mantissa = std::int32_t(link_.read(index, sub));
    const auto exponent = std::int16_t(link_.read(index, std::uint8_t(sub + 1)));
    return std::ldexp(mantissa, exponent);
}

void Master::read_scales() {
    const std::uint32_t version = link_.read(kAxis, 1);
    if (version != kVersion)
        throw can::BusError(fmt::format("node {} speaks version {}, expected {}",
                                        link_.options().node, version, kVersion));
    const std::uint64_t rate =
        std::uint64_t(link_.read(kAxis, 3)) << 32 | std::uint64_t(link_.read(kAxis, 2));
    scales_.sample_time_s = 1e6 / double(rate);
    scales_.rated_torque = read_scaled(kAxis, 4);
    scales_.count = read_scaled(kAxis, 6);
    scales_.linear = (link_.read(kAxis, 8) & 1) != 0;
    scales_.position_shift = int(link_.read(kAxis, 10));
    scales_.plan_capacity = int(link_.read(kAxis, 11));
    scales_.reference_count = link_.read(kAxis, 12);
    if (rate == 0 || !(scales_.rated_torque > 0) || !(scales_.count > 0))
        throw can::BusError(fmt::format("node {} gives no scales", link_.options().node));
}

// Two masters that claim at once see each other's answers: only the object tells whose it is.
void Master::claim() {
    try {
        link_.write(kCommand, 1, token_, 4);
    } catch (const SdoAbort& no) {
        if (no.code() != kNotNow) throw;
    }
    claimed_ = link_.read(kCommand, 1) == token_;
    if (!claimed_)
        throw can::BusError(fmt::format("node {} belongs to another master, or runs; wait for it, "
                                        "or stop it with `servoid command abort`",
                                        link_.options().node));
}

Status Master::status() {
    Status out;
    out.tick = link_.read(kStatus, 4);
    out.state = sid_state_t(link_.read(kStatus, 1));
    out.reason = sid_reason_t(link_.read(kStatus, 2));
    out.leg = int(link_.read(kStatus, 3));
    return out;
}

DriveCounts Master::counts() {
    return {long(link_.read(kStatus, 8)), long(link_.read(kStatus, 5))};
}

double Master::position() {
    for (int i = 0; i < 100; ++i) {
        if (const auto at = link_.telemetry().position()) return *at;
        link_.pump(milliseconds(20));
    }
    throw can::BusError(fmt::format("node {} sends no telemetry", link_.options().node));
}

void Master::start() {
    ++run_;
    link_.write(kCommand, 4, run_, 4);
}

void Master::set_up(const std::function<void()>& writes) try {
    writes();
    start();
} catch (const SdoAbort& no) {
    const int node = link_.options().node;
    if (no.code() != kNotNow) throw;
    if (link_.was_reset())
        throw can::BusError(fmt::format("node {} was reset before the run", node));
    if (link_.read(kCommand, 1) != token_)
        throw can::BusError(fmt::format("node {} is no longer ours: it was reset, or our heartbeat "
                                        "did not reach it in time",
                                        node));
    throw;
}

// An answer from before the start may come late: an end is believed when it is told twice.
std::optional<RunEnd> Master::end_of(const Status& now) {
    const bool runs = now.state == SID_STATE_MEASURING || now.state == SID_STATE_STOPPING;
    const bool reset = link_.was_reset();
    if (!reset && (runs || sid_state_t(link_.read(kStatus, 1)) != now.state)) return std::nullopt;
    if (reset || now.state == SID_STATE_IDLE)
        return RunEnd{now, fmt::format("node {} was reset during the run", link_.options().node)};
    return RunEnd{now, now.state == SID_STATE_DONE ? "" : sid_reason_text(now.reason)};
}

// Until something wants a closer look at the state: the telemetry tells an end, or has fallen
// silent. Each look takes some round trips in which nothing is streamed.
void Master::attend(const std::function<RunProgress()>& look, const OnProgress& progress) {
    const auto until = Link::Clock::now() + kLook;
    auto silent_at = Link::Clock::now() + kSilence;
    long rows = link_.telemetry().rows();
    do {
        const RunProgress told = look(); // streams, too
        if (progress && Link::Clock::now() >= progress_at_) {
            progress(told);
            progress_at_ = Link::Clock::now() + milliseconds(100);
        }
        link_.pump(milliseconds(5));
        if (std::exchange(rows, link_.telemetry().rows()) != rows)
            silent_at = Link::Clock::now() + kSilence;
    } while (Link::Clock::now() < std::min(until, silent_at) && !link_.tells_an_end());
}

// A drive whose time stands still would never end: its interrupt is dead, or waits for SYNC.
RunEnd Master::wait_for_end(const std::function<RunProgress(const Status&)>& look,
                            const OnProgress& progress) {
    Status now = status();
    auto lived_at = Link::Clock::now();
    while (true) {
        if (const auto end = end_of(now)) return *end;
        if (Link::Clock::now() - lived_at > kStalled)
            throw can::BusError(fmt::format("the time of node {} stands still: a free-running "
                                            "drive (--free)?",
                                            link_.options().node));
        attend([&] { return look(now); }, progress);
        const Status next = status();
        if (next.tick != now.tick) lived_at = Link::Clock::now();
        now = next;
    }
}

void Master::set_limit(std::uint8_t sub, double value, const char* option) try {
    if (value != 0 && !(value >= 1 && value <= 2147483647.0))
        throw UsageError(fmt::format("{}: not what this drive can count", option));
    link_.write(kLimits, sub, std::uint32_t(value), 4);
} catch (const SdoAbort& no) {
    if (no.code() != SID_SDO_RANGE) throw;
    throw UsageError(fmt::format("{}: wider than the drive itself allows", option));
}

void Master::set_limits(const Limits& limits) {
    const double count = scales_.count * std::ldexp(1, scales_.position_shift);
    set_limit(1, std::ldexp(limits.torque / scales_.rated_torque, 20), "--torque-limit");
    set_limit(2, limits.stroke / count, "--stroke");
}

void Master::set_plan(const std::vector<PlannedSine>& plan, const SessionOptions& options) {
    if (plan.empty() || int(plan.size()) > scales_.plan_capacity)
        throw UsageError(fmt::format("the drive takes 1 to {} frequencies", scales_.plan_capacity));
    const double unit = scales_.count * std::ldexp(1, scales_.position_shift - 8);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const double amplitude = std::round(plan[i].amplitude / unit);
        if (!(amplitude >= 1) || amplitude >= std::ldexp(1, 30) || plan[i].frequency_Hz > 4294)
            throw UsageError("--frequency, --amplitude: out of the drive's range");
        const auto leg = std::uint8_t(i + 1);
        link_.write(kFrequency, leg, std::uint32_t(std::llround(plan[i].frequency_Hz * 1e6)), 4);
        link_.write(kAmplitude, leg, std::uint32_t(amplitude), 4);
    }
    link_.write(kOptions, 1, std::uint32_t(plan.size()), 1);
    link_.write(kOptions, 2, std::uint32_t(options.windows), 1);
    link_.write(kOptions, 3, q8(options.ramp_periods), 2);
    link_.write(kOptions, 4, q8(options.settle_periods), 2);
    link_.write(kOptions, 5, q8(options.window_periods), 2);
    link_.write(kOptions, 6, 0, 2); // gap and rest: the core's own, whatever an earlier master said
    link_.write(kOptions, 7, 0, 4);
    link_.write(kOptions, 8, std::uint32_t(options.method), 1);
    link_.write(kCommand, 2, 1, 1);
}

RunEnd Master::identify(const std::vector<PlannedSine>& plan, const SessionOptions& options,
                        const OnProgress& progress) {
    set_up([&] { set_plan(plan, options); });
    const auto look = [&](const Status& now) {
        const auto leg = std::min(std::size_t(now.leg), plan.size() - 1);
        return RunProgress{
            fmt::format("leg {} of {}, {:.4g} Hz", leg + 1, plan.size(), plan[leg].frequency_Hz),
            double(leg) / double(plan.size()), link_.telemetry().rows()};
    };
    return wait_for_end(look, progress);
}

std::vector<SessionResult> Master::results(const std::vector<PlannedSine>& plan) {
    const double h = scales_.sample_time_s;
    const double c = scales_.count * std::ldexp(1, scales_.position_shift);
    std::vector<SessionResult> out;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto object = std::uint16_t(kResult + i);
        const double inertia = scales_.rated_torque * h * h / c,
                     viscous = scales_.rated_torque * h / c;
        SessionResult r;
        r.frequency_Hz = plan[i].frequency_Hz;
        r.reason = sid_reason_t(link_.read(object, 1));
        r.std_known = link_.read(object, 3) != 0;
        r.inertia = read_scaled(object, 4) * inertia;
        r.inertia_std = read_scaled(object, 6) * inertia;
        r.viscous = read_scaled(object, 8) * viscous;
        r.viscous_std = read_scaled(object, 10) * viscous;
        r.torque_amplitude = read_scaled(object, 12) * scales_.rated_torque;
        r.position_amplitude = read_scaled(object, 14) * c;
        out.push_back(r);
    }
    return out;
}

// How far the drive has come: told by itself after each frame of references, and asked for now and
// then. Its answer comes after all that was sent before: what it does not have was lost.
void Master::look_at_stream() {
    const auto now = Link::Clock::now();
    const can::TelemetryProgress& told = link_.telemetry().progress();
    const std::uint32_t filled = filled_, played = played_;
    if (told.sequence != told_) told_ = told.sequence, filled_ = told.filled, played_ = told.played;
    if (now >= ask_at_) {
        sent_ = filled_ = link_.read(kStatus, 6);
        const bool full = filled_ - played_ + kInFlight > scales_.reference_count;
        if (full) played_ = link_.read(kStatus, 7);
        ask_at_ = Link::Clock::now() + kAsk;
    }
    if (filled_ != filled || played_ != played) moved_at_ = now;
    if (now - moved_at_ > kStalled)
        throw can::BusError(
            fmt::format("node {} takes no references (CAN FD?)", link_.options().node));
}

// Ahead of what the drive plays, and again from where it stands where something was lost.
void Master::stream_some(const std::vector<std::int32_t>& references) {
    look_at_stream();
    const auto total = std::uint32_t(references.size());
    sent_ = std::max(sent_, filled_);
    const std::uint32_t end =
        std::min({total, played_ + scales_.reference_count, filled_ + kInFlight});
    while (sent_ < end) {
        const std::uint32_t count = std::min(kReferencesInFrame, end - sent_);
        link_.send(reference_frame(link_.options().node, references, sent_, count));
        sent_ += count;
    }
}

// As much as the drive wants before it starts.
void Master::fill(const std::vector<std::int32_t>& references) {
    const auto total = std::uint32_t(references.size());
    sent_ = filled_ = played_ = 0;
    told_ = link_.telemetry().progress().sequence;
    ask_at_ = moved_at_ = Link::Clock::now();
    link_.write(kCommand, 3, total, 4);
    const std::uint32_t ready = std::min(total, scales_.reference_count / 2 + 1);
    while (filled_ < ready || (filled_ = link_.read(kStatus, 6)) < ready) {
        stream_some(references);
        link_.pump(milliseconds(2));
        if (link_.was_reset())
            throw can::BusError(
                fmt::format("node {} was reset before the run", link_.options().node));
    }
}

RunEnd Master::move(const Experiment& experiment, const OnProgress& progress) {
    const std::vector<std::int32_t> references = references_of(experiment, scales_);
    const auto total = std::uint32_t(references.size());
    set_up([&] { fill(references); });
    const auto look = [&](const Status&) {
        if (filled_ < total) stream_some(references);
        const double h = scales_.sample_time_s;
        return RunProgress{fmt::format("{:.1f} of {:.1f} s", played_ * h, total * h),
                           double(played_) / double(total), link_.telemetry().rows()};
    };
    return wait_for_end(look, progress);
}

void Master::finish() {
    link_.wait(0.1);
    link_.write(kCommand, 6, 0, 1);
    link_.wait(0.05);
}

} // namespace servoid
