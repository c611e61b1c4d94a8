// Zero-phase band limit and derivatives, evaluated at any instant.
//
// Kernel: sinc of the band edge under a Blackman window of half length 3.1/band, so that it passes
// below 0.55 and stops above 1.45 of the band edge (stop band −74 dB). It is symmetric about the
// instant it is evaluated at, hence without phase, and evaluating it between two samples delays
// nothing: half a sample of hold or a dead time is a shift, not an interpolation.
// Instants closer to either end than half_length_s() have no value: nothing is padded.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace servoid {

// Instants start_s + k·step_s, k = 0 … count−1; sample 0 of a record is at 0.
struct Grid {
    double start_s = 0, step_s = 0;
    Eigen::Index count = 0;
    double at(Eigen::Index k) const { return start_s + double(k) * step_s; }
};

class LowPass {
  public:
    LowPass(double sample_time_s, double band_Hz);

    double half_length_s() const { return half_length_s_; }
    double band_Hz() const { return band_Hz_; }

    // x[i] is taken at i·sample_time + shift_s. derivative: 0, 1 or 2. Cost: count × 6.2/(band·T).
    Eigen::VectorXd apply(const Eigen::VectorXd& x, const Grid& grid, int derivative = 0,
                          double shift_s = 0) const;

    // Standard deviation out for white noise of standard deviation 1 in.
    double noise_gain(int derivative) const;

  private:
    using Taps = std::vector<double>;
    Taps taps(double phase, int derivative) const; // phase in samples, 0 ≤ phase < 1
    double kernel(double t_s, int derivative) const;

    struct Cache; // taps by phase and derivative: they cost more than applying them
    const Taps& cached_taps(int phase, int derivative) const;

    double sample_time_s_, band_Hz_, half_length_s_;
    long reach_;                   // taps on each side
    std::shared_ptr<Cache> cache_; // shared by copies, safe for threads
};

} // namespace servoid
