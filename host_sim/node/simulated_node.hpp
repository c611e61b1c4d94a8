// A simulated drive as a node on a bus: the core's node (sid_node.h) around SimulatedDrive.
#pragma once

#include "can/bus.hpp"
#include "plant/drive.hpp"
#include "servoid/sid_node.h"

#include <functional>
#include <vector>

namespace servoid {

struct NodeOptions {
    int node = 1, master = 127;
    int master_timeout_ms = 500, heartbeat_ms = 100;
    // Free-running: time passes only with the master's SYNC (0x80), so much for each, and the
    // heartbeat answers it. Else time is that of the machine's clock.
    bool free_running = false;
    double stroke = 0; // rad or m from the start of a run; 0: as far as the core can count
    DriveOptions drive;
};

// Control periods between two looks at the bus, and for one SYNC of a free-running drive.
constexpr int kPeriodsPerTurn = 8, kPeriodsPerSync = 40;

// What happened; for the summary at the end and for tests.
struct NodeReport {
    long periods = 0; // of control
    long runs = 0;
    sid_state_t state = SID_STATE_IDLE;
    sid_reason_t reason = SID_NOT_RUN;
    bool held = false;
    long held_after = -1;   // periods from the master's last heartbeat to the held reference
    double speed = 0;       // rad/s or m/s over the last turn
    double lost_time_s = 0; // the machine was too slow for real time
    long resets = 0;
    long rows_lost = 0;          // of telemetry: the bus took them too slowly
    long references_refused = 0; // frames of the last move that did not continue the ones before
};

class SimulatedNode {
  public:
    // Listens for two heartbeats first. Throws UsageError (a model without a controller, a stroke
    // that the core cannot count) and BusError (another drive of this number on the bus).
    SimulatedNode(const Model& model, const NodeOptions& options, can::Bus& bus);
    SimulatedNode(const SimulatedNode&) = delete;
    SimulatedNode& operator=(const SimulatedNode&) = delete;

    // Until `stop` says so; it is asked once a turn. Throws BusError where the bus is gone: by then
    // the axis has been held and has come to rest.
    void run(const std::function<bool()>& stop);
    // kPeriodsPerTurn and what is then to be sent, without a clock.
    void turn();
    NodeReport report() const;

  private:
    void power_up();
    void configure(const Model& model);
    void receive(std::chrono::nanoseconds wait);
    void answer(const can::Frame& frame);
    void answer_sync();
    void advance(int periods);
    void interrupt();
    void send_all();
    void refuse_if_taken();
    void come_to_rest();
    void wait_for_turn();

    NodeOptions options_;
    can::Bus& bus_;
    SimulatedDrive drive_;
    bool linear_;
    std::vector<sid_frequency_t> plan_;
    std::vector<sid_result_t> results_;
    std::vector<sid_row_t> rows_;
    std::vector<int32_t> references_;
    sid_node_config_t config_{};
    sid_node_t node_{};
    std::int32_t torque_ = 0, base_ = 0; // counts that the reference is added to before any run
    std::int32_t counts_before_ = 0;     // a turn ago
    std::uint32_t last_run_ = 0;
    bool due_ = false;  // a SYNC has come
    bool held_ = false; // as of the last period
    std::chrono::steady_clock::time_point next_{};
    NodeReport report_;
};

} // namespace servoid
