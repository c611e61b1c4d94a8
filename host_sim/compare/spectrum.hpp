// Power spectrum of a record.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace servoid {

struct Spectrum {
    double step_Hz = 0;
    Eigen::VectorXd power; // of bin k at k·step_Hz; the sum is the mean square of the signal
};

// Hann-windowed periodogram of the signal without its mean, one-sided.
Spectrum power_spectrum(const Eigen::VectorXd& signal, double sample_time_s);

// The frequency of the strongest line, interpolated between bins; 0 for a signal that is constant.
double strongest_line_Hz(const Eigen::VectorXd& signal, double sample_time_s);

// The strongest local maxima of the spectrum, at most `most`, strongest first.
std::vector<double> strongest_lines_Hz(const Eigen::VectorXd& signal, double sample_time_s,
                                       int most);

// How many independent numbers a residual holds, from the flatness of its spectrum: N for white
// noise up to the Nyquist frequency, few for a residual that repeats or drifts.
double effective_count(const Eigen::VectorXd& residual);

// What a likelihood counts at most. Laws are fitted to a motion that was measured and smoothed: two
// that come near each other are told apart by more than the number of samples.
constexpr double kMostCount = 150;

} // namespace servoid
