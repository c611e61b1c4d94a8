// What a campaign of the blind test amounts to, as text.
#pragma once

#include "blind/judge.hpp"

#include <string>
#include <vector>

namespace blind {

struct Figures {
    int cases = 0, right = 0;       // truth named first
    int missing = 0, ambiguous = 0; // of the right ones
    int parameters = 0, good_parameters = 0;
    int to_floor = 0;    // of the right ones: error_after ≤ 1.1 × the floor that the tool states
    int to_complete = 0; // the same with what a complete model leaves
    int to_true_floor = 0; // the same with the noise of the world, where that is more
    int adequate = 0, unknown_or_ambiguous = 0, found_all = 0, thrown = 0;
    double seconds = 0, slowest = 0;
};

Figures figures_of(const std::vector<Verdict>& verdicts);
std::string text_of(const Figures& figures);

// Markdown: rows are what was hidden, columns what was named.
std::string confusion_matrix(const std::vector<Verdict>& verdicts);

// Of the verdicts given with a probability in a bin, how many are right.
std::string calibration(const std::vector<Verdict>& verdicts);

} // namespace blind
