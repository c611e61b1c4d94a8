#include "compare/noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace servoid {

double sample_noise(const Eigen::VectorXd& signal, double quantum) {
    const double quantisation = quantum / std::sqrt(12.0);
    if (quantum > 0) return quantisation;
    const Eigen::Index n = signal.size() - 3;
    if (n < 1) return 0;
    std::vector<double> spread(static_cast<size_t>(n));
    for (Eigen::Index i = 0; i < n; ++i)
        spread[size_t(i)] =
            std::abs(signal[i + 3] - 3 * signal[i + 2] + 3 * signal[i + 1] - signal[i]);
    auto middle = spread.begin() + long(spread.size() / 2);
    std::nth_element(spread.begin(), middle, spread.end());
    return *middle / 0.6745 / std::sqrt(20.0);
}

double rms(const Eigen::VectorXd& x) {
    return x.size() ? x.norm() / std::sqrt(double(x.size())) : 0;
}

} // namespace servoid
