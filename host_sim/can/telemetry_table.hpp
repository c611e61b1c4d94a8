// Telemetry becomes captures: one for each run and stretch without a gap.
#pragma once

#include "can/bus_report.hpp"
#include "can/telemetry.hpp"
#include "servoid/sid_identify.h"

#include <map>
#include <optional>
#include <vector>

namespace servoid::can {

// The newest rows, for who looks on while they arrive.
struct LiveRows {
    std::vector<double> time_s; // since the start of the run
    std::vector<double> torque, position;
};

// Collects the telemetry of one node in the order of its arrival. The drive's own tick says when a
// row was sampled, so arrival times do not matter at all. A row counts once, however often it came;
// rows that come late are put in their place; what is missing splits the capture. A tick that goes
// back by more than a second, or a boot-up heartbeat, is a reset: what follows is another
// recording. Rows before the first start are left out where there is a run, else they are the
// capture. Memory: 24 bytes a row.
class TelemetryTable {
  public:
    // metadata: of a map, as [metadata] has it.
    explicit TelemetryTable(int node, std::map<std::string, std::string> metadata = {});
    void add(const Frame& frame);
    // The last description, once there was one.
    const std::optional<TelemetryDescription>& description() const { return description_; }
    long rows() const { return long(all_.size()); }
    // Of the newest row, rad or m from the encoder's zero; nothing before there is a description.
    std::optional<double> position() const;
    // At most `most` of the rows of the last `span_s`, evenly taken, in the order of their arrival;
    // none before there is a description.
    LiveRows newest(double span_s, std::size_t most) const;
    // Newest state, and how far a streamed move has come.
    std::uint8_t state() const { return state_; }
    const TelemetryProgress& progress() const { return progress_; }
    long resets() const { return seen_.resets; }
    // Throws FileError (no telemetry, no description) and Refusal (no 16 rows in a row).
    BusCaptures captures(const std::string& path) const;

  private:
    struct Row {
        std::int64_t tick; // unrolled; each reset begins far beyond all before it
        TelemetryRow row;
    };
    struct Run {
        std::int64_t start, end; // end: 0 where it was not seen
        TelemetryDescription description;
    };
    struct Stretch {
        std::size_t from, to; // rows
        const Run* run;
    };
    static std::vector<Stretch> stretches(const std::vector<Row>& rows,
                                          const std::vector<Run>& runs);
    void add_samples(const TelemetrySamples& samples, std::int64_t time_ns);
    void add_description(const TelemetryDescription& description);
    std::int64_t unroll(std::uint32_t tick);
    void begin_epoch();
    std::vector<Row> sorted(BusReport& report) const;
    Capture capture_of(const Row* first, const Row* end, const Run& run,
                       const std::string& path) const;
    double jitter_s() const;

    int node_;
    std::map<std::string, std::string> metadata_;
    std::optional<TelemetryDescription> description_;
    TelemetryProgress progress_;
    std::uint8_t state_ = 0;
    std::vector<Row> all_;
    std::vector<Run> runs_; // in the order of their starts; before the first start one with start 0
    std::int64_t epoch_ = 0, last_tick_ = 0, newest_ = 0; // newest_: of samples
    bool fresh_ = true;                                   // no tick of this epoch yet
    std::vector<double> arrival_s_;
    std::vector<long> arrival_tick_;
    BusReport seen_; // what is counted at once
};

} // namespace servoid::can
