// A candump log as captures, and back.
#pragma once

#include "can/bus_report.hpp"
#include "can/frame_map.hpp"
#include "capture/capture.hpp"

namespace servoid::can {

// Throws FileError (a line, a frame that is not there) and Refusal (nothing to build a row of).
BusCaptures read_candump(const std::string& path, const FrameMap& map, const CaptureScales& scales);

// A capture as the log of a drive that answers each SYNC (0x80) with one TPDO of CiA 402 (0x181):
// status word, position actual value in counts, torque demand in per mille of rated torque (objects
// 6041, 6064, 6074). Both are rounded.
// UsageError where the scales do not say what a count and the rated torque are, or a value does not
// fit its object.
std::string format_candump_log(const Capture& capture, const CaptureScales& scales);

} // namespace servoid::can
