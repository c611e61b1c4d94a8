// The scales of a CiA 402 drive, where somebody asked it for them while the log was written.
#pragma once

#include "can/frame.hpp"
#include "capture/capture.hpp"

#include <map>
#include <optional>

namespace servoid::can {

// Hears the drive's answers to SDO reads (CiA 301, expedited) of its objects:
//   0x6076    rated torque, mN·m: what 1000 per mille are
//   0x608F    encoder increments per motor revolutions: what a count is, where no feed is known
//   0x6091    motor revolutions per shaft revolutions
//   0x6092    feed in position units per shaft revolutions: what a position unit is
// The last answer counts. Masters commonly read them when they start.
class Cia402Scales {
  public:
    explicit Cia402Scales(int node) : answer_{0x580U + std::uint32_t(node), false} {}
    void add(const Frame& frame);
    // What `known` lacks and was heard. Positions become rad of the motor.
    CaptureScales complete(CaptureScales known) const;

  private:
    // Of sub-indices 1 and 2; nothing where either is missing or 0.
    std::optional<double> ratio(std::uint16_t index) const;

    FrameId answer_;
    std::map<std::uint32_t, std::uint32_t> heard_; // index << 8 | sub-index
};

} // namespace servoid::can
