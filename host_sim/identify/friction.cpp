#include "identify/friction.hpp"

#include "common/error.hpp"
#include "identify/core_window.hpp"
#include "servoid/sid_friction.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kSpeedUnits = 1 << 22;
constexpr double kTorqueUnits = 1 << 20;

struct Scale {
    double speed, torque; // SI of one unit of the core
};

Scale scale_of(const std::vector<SpeedRun>& runs) {
    double speed = 0, torque = 0;
    for (const SpeedRun& run : runs) {
        speed = std::max(speed, std::abs(run.velocity));
        torque = std::max(torque, std::abs(run.torque));
    }
    return {speed / kSpeedUnits, (torque > 0 ? torque : 1) / (4 * kTorqueUnits)};
}

sid_friction_result_t by_the_core(const std::vector<SpeedRun>& runs, const Scale& scale) {
    sid_friction_t friction;
    sid_friction_init(&friction);
    for (const SpeedRun& run : runs)
        sid_friction_step(&friction, int32_t(std::lround(run.velocity / scale.speed)),
                          int32_t(std::lround(run.torque / scale.torque)));
    sid_friction_result_t result;
    sid_friction_solve(&friction, &result);
    return result;
}

void refuse(const sid_friction_result_t& result) {
    const char* runs_wanted = "constant-speed runs at three or more speeds in both directions";
    switch (result.status) {
    case SID_FRICTION_ONE_DIRECTION:
        throw Refusal("the runs go one way only: Coulomb friction and a constant torque cannot be "
                      "told apart",
                      runs_wanted);
    case SID_FRICTION_ONE_SPEED:
        throw Refusal("the runs of one direction all have the same speed: viscous and Coulomb "
                      "friction cannot be told apart",
                      runs_wanted);
    case SID_FRICTION_NOT_RUN:
        throw Refusal("there is no run to fit", runs_wanted);
    default:
        break;
    }
}

// Standard deviations from the spread of the run means about the line of their direction: the
// samples inside a run are not independent, the runs are.
DirectionFit direction_fit(const std::vector<SpeedRun>& runs, double sign, double slope,
                           double offset) {
    DirectionFit out;
    double sv = 0, svv = 0, rss = 0;
    for (const SpeedRun& run : runs) {
        if (run.velocity * sign <= 0) continue;
        ++out.runs;
        sv += run.velocity, svv += run.velocity * run.velocity;
        const double r = run.torque - slope * run.velocity - offset;
        rss += r * r;
    }
    const double n = out.runs, determinant = n * svv - sv * sv;
    const double variance = n > 2 ? rss / (n - 2) : 0;
    out.viscous = {slope, std::sqrt(variance * n / determinant)};
    out.offset = {sign * offset, std::sqrt(variance * svv / determinant)};
    return out;
}

Estimate half_sum(const Estimate& a, const Estimate& b, double value) {
    return {value, std::hypot(a.std, b.std) / 2};
}

} // namespace

FrictionResult fit_friction(std::vector<SpeedRun> runs) {
    const Scale scale = scale_of(runs);
    const sid_friction_result_t core = by_the_core(runs, scale);
    refuse(core);
    const double per_speed = scale.torque * kTorqueUnits / scale.speed;
    const double per_unit = scale.torque * kTorqueUnits;
    FrictionResult out;
    out.forward = direction_fit(runs, 1, to_double(core.slope[0]) * per_speed,
                                to_double(core.offset[0]) * per_unit);
    out.reverse = direction_fit(runs, -1, to_double(core.slope[1]) * per_speed,
                                to_double(core.offset[1]) * per_unit);
    const DirectionFit &f = out.forward, &r = out.reverse;
    out.viscous = half_sum(f.viscous, r.viscous, (f.viscous.value + r.viscous.value) / 2);
    out.coulomb = half_sum(f.offset, r.offset, (f.offset.value + r.offset.value) / 2);
    out.constant_torque = half_sum(f.offset, r.offset, (f.offset.value - r.offset.value) / 2);
    for (SpeedRun& run : runs) {
        const DirectionFit& side = run.velocity > 0 ? f : r;
        const double sign = run.velocity > 0 ? 1 : -1;
        run.residual = run.torque - side.viscous.value * run.velocity - sign * side.offset.value;
    }
    out.runs = std::move(runs);
    return out;
}

} // namespace servoid
