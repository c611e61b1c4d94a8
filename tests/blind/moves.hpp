// References as someone who commissions a drive would choose them.
#pragma once

#include "blind/random.hpp"

#include <functional>
#include <string>
#include <vector>

namespace blind {

// The reference before its amplitude is chosen: of the order of 1.
struct Move {
    std::string kind;
    double period_s = 0; // 0: does not repeat
    double duration_s = 0;
    double top_Hz = 0; // highest frequency that it excites on purpose
    std::function<double(double)> at;
    std::vector<double> sample(double step_s, double amplitude) const;
};

// There and back at several speeds (fractions of 1 per second), with limited acceleration; `long_`:
// every leg goes the whole way, else each lasts about as long as the others.
struct SpeedsRequest {
    std::vector<double> speeds; // per second
    double acceleration = 10;   // per second squared
    double stroke = 1;          // of the longest leg
    double dwell_s = 0;
    bool whole_way = false;
    int cycles = 3;
};
Move speeds(const SpeedsRequest& request);

// Lines at multiples of base_Hz up to top_Hz, random phases, amplitude ∝ 1/f^slope.
struct MultisineRequest {
    double base_Hz = 1, from_Hz = 1, top_Hz = 100, slope = 0;
    int periods = 4;
};
Move multisine(const MultisineRequest& request, Random& random);

// One sine after another, each with whole cycles and a soft start and end; amplitude ∝ 1/f^slope.
Move sines(const std::vector<double>& frequencies_Hz, double slope, int cycles_each, int repeats);

// A sweep up, logarithmic in frequency, and back down.
Move chirp(double from_Hz, double top_Hz, double slope, double sweep_s, int repeats);

} // namespace blind
