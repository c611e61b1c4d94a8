// Does the experiment repeat, and with which period?
#pragma once

#include "capture/capture.hpp"

#include <optional>

namespace servoid {

// The stated period, else the shortest one after which the reference (or, without a reference, the
// position less its slow drift) repeats; nothing where there are not two whole periods.
std::optional<double> find_period(const Capture& capture);

} // namespace servoid
