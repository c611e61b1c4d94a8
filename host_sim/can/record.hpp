// A move that is heard on a live bus, up to its end.
#pragma once

#include "can/bus.hpp"
#include "can/collector.hpp"

#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace servoid::can {

struct RecordOptions {
    std::optional<double> for_s; // from the first data frame on; else until they cease
    double idle_s = 2;           // without a data frame: the end
    double wait_s = 10;          // for the first one
    double trouble_s = 2.5;      // longer than the bus takes to report that it does not recover
    const std::atomic<bool>* stop = nullptr; // the user wants an end; looked at every 50 ms
    std::function<void()> begun;             // after the first data frame: time to narrow filters
};

// Mapped frames and error frames go into the table, and into the log where one is kept; every other
// frame is told only where the mapped ones do not come. Data frames are the mapped ones but SYNC,
// which a bus at rest carries too.
class Recorder {
  public:
    Recorder(const FrameMap& map, std::string interface, bool keep_log);

    // Throws BusError where an identifier of the map does not come, or the bus fails. What came
    // before stays in the table and the log.
    void run(Bus& bus, const RecordOptions& options);

    const Collector& table() const { return table_; }
    const std::string& log() const { return log_; } // as candump -L writes it

  private:
    void wait_for_first(Bus& bus, const RecordOptions& options);
    void listen(Bus& bus, const RecordOptions& options);
    bool keep(const Frame& frame); // true: a data frame
    void refuse_if_missing(double seconds) const;

    std::vector<FrameId> data_, mapped_;
    std::string interface_;
    bool keep_log_;
    Collector table_;
    std::string log_;
    std::set<FrameId> seen_;
};

} // namespace servoid::can
