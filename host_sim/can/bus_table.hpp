// Frames become the rows of captures: one row a cycle, and no row that was not received whole.
#pragma once

#include "can/bus_clock.hpp"
#include "can/frame_map.hpp"
#include "capture/raw_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid::can {

struct BusReport {
    long frames = 0;       // all that were seen
    long used = 0;         // that stand in a row
    long lost = 0;         // cycles of which a frame is missing
    long repeated = 0;     // the same once more
    long late = 0;         // more than half a period after their time
    long reordered = 0;    // after one that was sent later (seen by a counter or a device time)
    long short_frames = 0; // too few bytes for the map
    long errors = 0;       // error frames of the bus; of them:
    long bus_off = 0, restarted = 0, error_passive = 0, error_warning = 0;
    long dropped = 0;        // that the logger says it missed, or a live bus had no room for
    long interface_down = 0; // how often, while a live bus was heard
    double period_s = 0;
    double jitter_s = 0; // rms of the arrivals about the fitted clock
    std::string clock;   // what gave the instants: "SYNC", "counter", "device time", "arrival"
};

// Collects the mapped frames in the order of their arrival; then the tables, one for each stretch
// without a gap that has at least 16 rows, SI or as the columns' names say. Memory: some 30 bytes
// and 8 a signal for each frame, and 50 more while the tables are made.
class BusTable {
  public:
    explicit BusTable(FrameMap map);
    void add(const Frame& frame);
    // Throws FileError (a mapped identifier was never seen) and Refusal (too few cycles).
    std::vector<RawTable> tables(const std::string& path, BusReport& report) const;

  private:
    struct Arrivals {
        FrameId id;
        int bytes = 0;                    // a frame must have
        std::vector<std::size_t> signals; // which of the map's it holds
        std::vector<double> time_s;
        std::vector<long> before;                // SYNC frames before it
        std::vector<std::int64_t> counts, ticks; // where it holds them
        std::vector<std::vector<double>> values; // for each signal
    };
    using Cycles = std::vector<std::vector<long>>;
    struct Placed {
        std::vector<std::map<long, std::size_t>> at; // for each identifier: cycle to arrival
        long first = 0, last = -1;                   // cycles in which all of them have begun
    };
    Arrivals* find(FrameId id);
    void count_error(const Frame& frame);
    void refuse_if_missing(const std::string& path) const;
    FittedClock clock_of(const Arrivals& arrivals, BusReport& report) const;
    Cycles cycles_by_sync(BusReport& report) const;
    Cycles cycles(BusReport& report) const;
    Placed place(BusReport& report) const;
    std::vector<long> whole_cycles(const Placed& placed) const;
    RawTable table_of(const Placed& placed, long first, long end, double period_s) const;

    FrameMap map_;
    std::int64_t first_ns_ = 0;
    BusReport seen_; // frames, errors, short_frames: what is counted at once
    std::vector<double> sync_s_;
    std::vector<Arrivals> arrivals_;
};

} // namespace servoid::can
