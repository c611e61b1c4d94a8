// Frames become the rows of captures: one row a cycle, and no row that was not received whole.
#pragma once

#include "can/bus_clock.hpp"
#include "can/bus_report.hpp"
#include "can/frame_map.hpp"
#include "capture/raw_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid::can {

// Collects the mapped frames in the order of their arrival; then the tables, one for each stretch
// without a gap that has at least 16 rows, SI or as the columns' names say. Memory: some 30 bytes
// and 8 a signal for each frame, and 50 more while the tables are made.
class BusTable {
  public:
    explicit BusTable(FrameMap map);
    void add(const Frame& frame);
    // Throws FileError (a mapped identifier was never seen) and Refusal (too few cycles).
    // complete: nothing was lost on the way here, so that each SYNC is the next cycle.
    std::vector<RawTable> tables(const std::string& path, BusReport& report,
                                 bool complete = false) const;

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
    void refuse_if_missing(const std::string& path) const;
    FittedClock clock_of(const Arrivals& arrivals, BusReport& report) const;
    bool comes_in_bursts(const FittedClock& clock) const;
    Cycles cycles_by_sync(BusReport& report, bool complete) const;
    Cycles cycles(BusReport& report, bool complete) const;
    Placed place(BusReport& report, bool complete) const;
    std::vector<long> whole_cycles(const Placed& placed) const;
    RawTable table_of(const Placed& placed, long first, long end, double period_s) const;

    FrameMap map_;
    std::int64_t first_ns_ = 0;
    BusReport seen_; // frames, errors, short_frames: what is counted at once
    std::vector<double> sync_s_;
    std::vector<Arrivals> arrivals_;
};

} // namespace servoid::can
