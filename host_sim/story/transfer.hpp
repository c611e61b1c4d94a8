// Frequency response of one record to another, with its coherence.
//
// H1 = S_yx/S_xx (Bendat and Piersol, Random Data, 4th ed., chapter 6; standard deviation of the
// gain: eq. (9.89), |H|·sqrt((1 − γ²)/(2 n γ²)) with n independent segments). Segments are one
// period of a move that repeats, without window: its lines are then exact. Else eight half
// overlapping segments under a Hann window.
#pragma once

#include "compare/low_pass.hpp"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace servoid {

struct TransferLine {
    double frequency_Hz = 0;
    std::complex<double> response;
    double coherence = 0;    // γ², 0 … 1
    double relative_std = 0; // of the gain
};

struct Segments {
    std::optional<double> period_s;
    double highest_Hz = 0;
};

// Lines at which x holds power (a ten thousandth of its strongest), up to the highest. Empty where
// the record has less than two segments.
std::vector<TransferLine> transfer(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                   double step_s, const Segments& segments);

} // namespace servoid
