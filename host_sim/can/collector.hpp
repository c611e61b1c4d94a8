// What turns heard frames into captures, whatever they are: mapped fields, or servoid's telemetry.
#pragma once

#include "can/bus_table.hpp"
#include "can/cia402_scales.hpp"
#include "can/telemetry_table.hpp"

#include <variant>

namespace servoid::can {

class Collector {
  public:
    explicit Collector(const FrameMap& map);
    void add(const Frame& frame);
    // scales: where the frames bring none of their own. path: for messages. Throws FileError (a
    // frame that is not there) and Refusal (nothing to build a row of).
    // complete: of a live bus, that had room for everything.
    BusCaptures captures(const std::string& path, const CaptureScales& scales,
                         bool complete = false) const;

  private:
    std::variant<BusTable, TelemetryTable> table_;
    std::optional<Cia402Scales> told_;
};

} // namespace servoid::can
