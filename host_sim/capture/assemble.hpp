// From a recording in its own units to a checked Capture in SI.
#pragma once

#include "capture/capture.hpp"
#include "capture/raw_table.hpp"

namespace servoid {

Capture assemble(RawTable table, const CaptureScales& scales);

} // namespace servoid
