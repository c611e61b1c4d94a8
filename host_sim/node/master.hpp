// What a master does with a drive: claim it, run a session or a move, and take what it tells.
#pragma once

#include "identify/identify.hpp"
#include "node/link.hpp"
#include "plant/experiment.hpp"
#include "plant/session.hpp"

#include <functional>
#include <string>
#include <vector>

namespace servoid {

// The drive's scales, read from its objects.
struct DriveScales {
    double sample_time_s = 0;
    double rated_torque = 0; // N·m or N
    double count = 0;        // rad or m
    bool linear = false;
    int position_shift = 0, plan_capacity = 0;
    std::uint32_t reference_count = 0;
};

struct Status {
    sid_state_t state = SID_STATE_IDLE;
    sid_reason_t reason = SID_NOT_RUN;
    int leg = 0;
};

// Told some ten times a second of the machine's time.
struct RunProgress {
    std::string what; // "leg 2 of 5, 60 Hz", "3.2 of 7.1 s"
    double share = 0; // 0…1
    long samples = 0; // of telemetry so far
};
using OnProgress = std::function<void(const RunProgress&)>;

// How a run ended. `fault` is empty where it ran to its end.
struct RunEnd {
    Status status;
    std::string fault;
};

class Master {
  public:
    // Claims the node, sets the time of the heartbeat, turns telemetry on. Throws BusError: silent,
    // another version, claimed by another master.
    explicit Master(Link& link);
    // Ends a run that is on, gives the node back; says nothing where the bus is gone.
    ~Master();
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;

    const DriveScales& scales() const { return scales_; }
    Status status();
    double position(); // rad or m, of the newest sample; waits for one

    // A session of these sines (reference amplitudes in rad or m) by the drive's own core. The
    // results, one for each, are worth something where the end is without fault.
    RunEnd identify(const std::vector<PlannedSine>& plan, const SessionOptions& options,
                    const OnProgress& progress);
    std::vector<SessionResult> results(const std::vector<PlannedSine>& plan);

    // Streams the experiment's reference from where the axis stands.
    RunEnd move(const Experiment& experiment, const OnProgress& progress);

    // Lets the drive come to rest and send what it still has.
    void finish();

  private:
    void read_scales();
    void claim();
    void start();
    RunEnd wait_for_end(const std::function<RunProgress(const Status&)>& look,
                        const OnProgress& progress);
    void set_plan(const std::vector<PlannedSine>& plan, const SessionOptions& options);
    void stream_some(const std::vector<std::int32_t>& references);
    double read_scaled(std::uint16_t index, std::uint8_t sub);

    Link& link_;
    DriveScales scales_;
    std::uint32_t token_, run_;
    std::uint32_t sent_ = 0, filled_ = 0, played_ = 0; // of a streamed move
    int stalled_ = 0;
    Link::Clock::time_point progress_at_{};
    bool claimed_ = false;
};

// Whether the reason is one that the data gives (nothing was excited, say), not a fault.
bool is_refusal(sid_reason_t reason);

} // namespace servoid
