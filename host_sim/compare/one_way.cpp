#include "compare/one_way.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

bool moves_one_way(const std::vector<PreparedMotion>& motions) {
    double forward = 0, reverse = 0;
    for (const PreparedMotion& m : motions)
        for (Eigen::Index k = 0; k < m.velocity.size(); ++k)
            if (m.used[size_t(k)])
                (m.velocity[k] > 0 ? forward : reverse) += std::abs(m.velocity[k]) * m.grid.step_s;
    return std::min(forward, reverse) <= 0.02 * std::max(forward, reverse);
}

double work_share(const std::vector<PreparedMotion>& motions) {
    double work = 0, size = 0;
    for (const PreparedMotion& m : motions) {
        const Eigen::VectorXd power = m.torque.cwiseProduct(m.velocity);
        work += power.sum(), size += power.cwiseAbs().sum();
    }
    return size > 0 ? work / size : 0;
}

} // namespace servoid
