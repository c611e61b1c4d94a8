#include "compare/against.hpp"

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

Vector rate_of(const Vector& x, double step_s) {
    Vector out = Vector::Zero(x.size());
    for (Eigen::Index k = 1; k + 1 < x.size(); ++k)
        out[k] = (x[k + 1] - x[k - 1]) / (2 * step_s);
    return out;
}

} // namespace

Vector variable_of(Against against, const PreparedMotion& motion, const Vector& torque) {
    const Grid& grid = motion.grid;
    switch (against) {
    case Against::position:
        return motion.position;
    case Against::acceleration:
        return motion.acceleration;
    case Against::time:
        return Vector::LinSpaced(grid.count, grid.at(0), grid.at(grid.count - 1));
    case Against::torque:
        return torque;
    case Against::torque_rate:
        return rate_of(torque, grid.step_s);
    case Against::velocity:
    case Against::in_phase:
    case Against::quadrature:
        break;
    }
    return motion.velocity;
}

} // namespace servoid
