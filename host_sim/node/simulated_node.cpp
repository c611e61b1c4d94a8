#include "node/simulated_node.hpp"

#include "can/telemetry.hpp"
#include "common/scaled.hpp"
#include "node/core_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

namespace servoid {

namespace {

using std::chrono::nanoseconds;

constexpr int kPlan = 32, kRows = 16384, kReferences = 8192; // a second or two at 8 kHz
constexpr std::uint32_t kSync = 0x80;
constexpr std::uint32_t kReplay = 4096; // samples that the background works off in a turn
constexpr int kFramesAtOnce = 64;
constexpr std::int32_t kFurthest = (1 << 23) - 1;

std::int32_t stroke_counts(double stroke, double per_count, std::int32_t step_limit) {
    const std::int32_t most = kFurthest - step_limit;
    if (stroke <= 0) return most;
    const double counts = stroke / per_count;
    if (!(counts >= 1) || counts > most)
        throw UsageError(
            "--stroke: less than a count of the encoder, or more than the core counts");
    return std::int32_t(counts);
}

} // namespace

SimulatedNode::SimulatedNode(const Model& model, const NodeOptions& options, can::Bus& bus)
    : options_(options), bus_(bus), drive_(model, options.drive),
      linear_(model.motion == Motion::linear), plan_(kPlan), results_(kPlan), rows_(kRows),
      references_(kReferences) {
    refuse_if_taken();
    configure(model);
    power_up();
    next_ = std::chrono::steady_clock::now();
}

void SimulatedNode::configure(const Model& model) {
    const double per_count = drive_.position_per_count();
    config_.axis.sample_rate_uHz = std::uint64_t(std::llround(1e6 / drive_.sample_time_s()));
    config_.axis.rated_torque = to_scaled(drive_.full_torque());
    config_.axis.count = to_scaled(per_count);
    config_.axis.encoder_increments =
        std::uint32_t(std::llround((linear_ ? 1 : 2 * std::numbers::pi) / per_count));
    config_.axis.encoder_revolutions = 1;
    config_.axis.linear = linear_;
    config_.identify.results = results_.data();
    config_.identify.torque_timing = SID_TORQUE_HELD_LAST;
    config_.identify.step_limit_count = 1 << 16;
    config_.identify.stroke_limit_count =
        stroke_counts(options_.stroke, per_count, config_.identify.step_limit_count);
    // A torque at the limit is cut off: no inertia follows from it.
    if (model.drive.torque_limit > 0) {
        const double limit = std::ldexp(model.drive.torque_limit / drive_.full_torque(), 20);
        config_.identify.torque_limit_pu_q20 = std::int32_t(std::min(limit + 1, double(kFurthest)));
        config_.identify.torque_saturation_pu_q20 =
            std::int32_t(std::min(limit, double(kFurthest)));
    }
    config_.plan = plan_.data(), config_.plan_capacity = kPlan;
    config_.node_id = std::uint8_t(options_.node);
    config_.master_id = std::uint8_t(options_.master);
    config_.master_timeout_ms = std::uint16_t(options_.master_timeout_ms);
    config_.heartbeat_ms = std::uint16_t(options_.free_running ? 0 : options_.heartbeat_ms);
    config_.rows = rows_.data(), config_.row_count = kRows;
    config_.references = references_.data(), config_.reference_count = kReferences;
}

// After power-up and after a reset the drive holds the axis where it stands.
void SimulatedNode::power_up() {
    base_ = drive_.counts();
    if (!sid_node_init(&node_, &config_)) throw Error(ExitCode::defect, "the node's configuration");
    last_run_ = 0;
    interrupt(); // the timer runs before the bus is served,
    send_all();  // and the boot-up is said before anything is answered
}

void SimulatedNode::interrupt() {
    const sid_sample_t sample = {std::uint32_t(drive_.counts()), torque_};
    sid_command_t command;
    sid_node_step(&node_, &sample, &command);
    // Now: another master's heartbeat may come before anybody looks.
    if (node_.held != 0 && !held_) report_.held_after = long(node_.held_tick - node_.master_seen);
    held_ = node_.held != 0;
    const std::int32_t zero = node_.run.start_tick != 0 ? std::int32_t(node_.run.start_raw) : base_;
    const std::int32_t reference =
        std::int32_t(std::uint32_t(zero) * 256U + std::uint32_t(command.reference_q8));
    torque_ = drive_.step_q8(reference).torque_pu_q20;
    ++report_.periods;
}

void SimulatedNode::advance(int periods) {
    for (int k = 0; k < periods; ++k) {
        if (k % kPeriodsPerTurn == 0) counts_before_ = drive_.counts();
        interrupt();
    }
    if (node_.run_number != last_run_) ++report_.runs;
    last_run_ = node_.run_number;
}

void SimulatedNode::send_all() {
    sid_can_frame_t frame;
    while (sid_node_poll(&node_, kReplay, &frame))
        bus_.send(from_core(frame));
}

void SimulatedNode::answer(const can::Frame& frame) {
    if (options_.free_running && id_of(frame) == can::FrameId{kSync, false}) due_ = true;
    sid_can_frame_t asked, reply;
    if (!to_core(frame, asked)) return;
    if (sid_node_receive(&node_, &asked, &reply)) bus_.send(from_core(reply));
}

// No more at once than leaves the control its time.
void SimulatedNode::receive(nanoseconds wait) {
    can::Frame frame;
    for (int i = 0; i < kFramesAtOnce && !due_ && bus_.receive(frame, wait); ++i) {
        answer(frame);
        wait = nanoseconds(0);
    }
}

void SimulatedNode::turn() {
    advance(kPeriodsPerTurn);
    send_all();
    if (!sid_node_is_reset_requested(&node_)) return;
    come_to_rest();
    report_.rows_lost += long(node_.telemetry.lost);
    power_up();
    ++report_.resets;
}

// Real time: the turn begins when the clock says so; what cannot be made up for is lost time.
void SimulatedNode::wait_for_turn() {
    const auto length = nanoseconds(std::llround(1e9 * kPeriodsPerTurn * drive_.sample_time_s()));
    next_ += length;
    const auto now = std::chrono::steady_clock::now();
    if (now - next_ > std::chrono::milliseconds(100)) {
        report_.lost_time_s += std::chrono::duration<double>(now - next_).count();
        next_ = now;
    }
    receive(nanoseconds(0));
    while (std::chrono::steady_clock::now() < next_)
        receive(next_ - std::chrono::steady_clock::now());
}

// A free-running drive: so many turns for a SYNC, and the heartbeat says that they are over.
void SimulatedNode::answer_sync() {
    receive(std::chrono::milliseconds(50));
    if (!due_) {
        send_all(); // what needs no time: boot-up, progress
        return;
    }
    due_ = false;
    for (int k = 0; k < kPeriodsPerSync; k += kPeriodsPerTurn)
        turn();
    can::Frame done;
    done.id = can::heartbeat_id(options_.node).id, done.length = 1, done.data[0] = 5;
    bus_.send(done);
}

// Two drives of one number would both answer. One that beats is heard before we say anything.
void SimulatedNode::refuse_if_taken() {
    if (options_.free_running) return;
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::milliseconds(options_.heartbeat_ms * 5 / 2);
    can::Frame frame;
    for (auto now = until; (now = std::chrono::steady_clock::now()) < until;)
        if (bus_.receive(frame, until - now) && id_of(frame) == can::heartbeat_id(options_.node))
            throw can::BusError(
                fmt::format("there is a node {} on this bus already (--node)", options_.node));
}

void SimulatedNode::run(const std::function<bool()>& stop) try {
    while (!stop()) {
        if (options_.free_running) {
            answer_sync();
        } else {
            wait_for_turn();
            turn();
        }
    }
    come_to_rest();
} catch (const can::BusError&) {
    come_to_rest();
    throw;
}

// The drive goes on without the bus: its own watch on the master ends a run that is on.
void SimulatedNode::come_to_rest() {
    const double limit_s =
        std::max<int>(options_.master_timeout_ms, node_.master_timeout_ms) * 1e-3 + 1;
    const long periods = std::lround(limit_s / drive_.sample_time_s());
    sid_can_frame_t frame;
    for (long k = 0; k < periods; k += kPeriodsPerTurn) {
        advance(kPeriodsPerTurn);
        while (sid_node_poll(&node_, kReplay, &frame)) {
        }
    }
}

NodeReport SimulatedNode::report() const {
    NodeReport out = report_;
    out.state = sid_state_t(node_.state), out.reason = sid_reason_t(node_.reason);
    out.held = node_.held != 0;
    out.rows_lost += long(node_.telemetry.lost);
    out.references_refused = long(node_.stream.refused);
    out.speed = (drive_.counts() - counts_before_) * drive_.position_per_count() /
                (kPeriodsPerTurn * drive_.sample_time_s());
    return out;
}

} // namespace servoid
