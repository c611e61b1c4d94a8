// What a master does with a drive: claim it, run a session or a move, and take what it tells.
#pragma once

#include "identify/identify.hpp"
#include "node/link.hpp"
#include "plant/experiment.hpp"
#include "plant/session.hpp"

#include <functional>
#include <optional>
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
    std::uint32_t tick = 0; // the drive's time
};

// Beyond them the drive itself holds its axis: N·m or N, and rad or m from the start of the run.
// 0: what the drive is configured with, and no wider than that.
struct Limits {
    double torque = 0, stroke = 0;
};

// Told some ten times a second of the machine's time.
struct RunProgress {
    std::string what; // "leg 2 of 5, 60 Hz", "3.2 of 7.1 s"
    double share = 0; // 0…1
    long samples = 0; // of telemetry so far
};
using OnProgress = std::function<void(const RunProgress&)>;

// What the drive has counted: frames of references that did not continue the ones before, in the
// last move; rows of telemetry that it could not send, since it was switched on.
struct DriveCounts {
    long references_refused = 0, rows_lost = 0;
};

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
    // Ends a run that is on, gives the node back, if it is ours yet; says nothing where the bus is
    // gone.
    ~Master();
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;

    const DriveScales& scales() const { return scales_; }
    Status status();
    DriveCounts counts();
    double position(); // rad or m, of the newest sample; waits for one

    // For every run from now on. Throws UsageError where they are wider than the drive's own.
    void set_limits(const Limits& limits);

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
    // What the run needs is written, then it is started. Says why where the node does not take it.
    void set_up(const std::function<void()>& writes);
    RunEnd wait_for_end(const std::function<RunProgress(const Status&)>& look,
                        const OnProgress& progress);
    void attend(const std::function<RunProgress()>& look, const OnProgress& progress);
    std::optional<RunEnd> end_of(const Status& now);
    void set_plan(const std::vector<PlannedSine>& plan, const SessionOptions& options);
    void set_limit(std::uint8_t sub, double value, const char* option);
    void fill(const std::vector<std::int32_t>& references);
    void stream_some(const std::vector<std::int32_t>& references);
    void look_at_stream();
    double read_scaled(std::uint16_t index, std::uint8_t sub);

    Link& link_;
    DriveScales scales_;
    std::uint32_t token_, run_;
    std::uint32_t sent_ = 0, filled_ = 0, played_ = 0; // of a streamed move
    std::uint16_t told_ = 0;                           // number of the drive's last word on it
    Link::Clock::time_point ask_at_{}, moved_at_{}, progress_at_{};
    bool claimed_ = false;
};

// Whether the reason is one that the data gives (nothing was excited, say), not a fault.
bool is_refusal(sid_reason_t reason);

} // namespace servoid
