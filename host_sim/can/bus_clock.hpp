// When frames were sampled, from when they arrived.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace servoid::can {

// t = start_s + period_s·k
struct FittedClock {
    double start_s = 0, period_s = 0;
    double jitter_s = 0;     // rms of what arrives about it
    double latest_s = 0;     // largest delay after it
    std::vector<long> cycle; // k of each arrival; rising, but for a repeated frame
};

// The clock of one identifier's arrivals (s, in their order). A frame may wait for the bus and be
// late, for a while; it is never early. So a lasting step back of the delay is a repeated frame, a
// lasting step forward of a period is a lost one (the least of the next few delays decides).
// Period: as stated, else the median distance, then the straight line through all of it. Refusal:
// fewer than 8 arrivals.
FittedClock fit_clock(const std::vector<double>& arrivals_s, std::optional<double> period_s);

// The same where every arrival is the next cycle, and where the cycles are known: the straight line
// of arrivals over them.
FittedClock counted_clock(const std::vector<double>& arrivals_s, std::optional<double> period_s);
FittedClock line_through(const std::vector<double>& arrivals_s, const std::vector<long>& cycle);

// A counter of `bits` bits that rolls over, as numbers that do not. A step of less than half its
// range back is a frame that came late.
std::vector<long> unrolled(const std::vector<std::int64_t>& counts, int bits);

} // namespace servoid::can
