// The events of a Body: sticking, breaking away, and the faces of the gap.
#include "plant/axis_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace servoid {

// Force with which the face in contact presses on the load of a rigid gap; negative: it would pull.
double Body::pressing(const BodyState& y, const BodyState& slope) const {
    const double x_load = y.x - y.p;
    const double load = load_ * wave(x_load);
    return contact_ * (load * slope.w + load_ * wave_slope(x_load) * y.w * y.w / 2);
}

double Body::gap_margin(const BodyState& y, const BodyState& slope) const {
    if (contact_ == 0) return (half_gap_ - std::abs(y.p)) / half_gap_;
    if (kind_ == Kind::sprung_gap) return (contact_ * y.p - half_gap_) / half_gap_;
    return pressing(y, slope);
}

double Body::margin(double at, const BodyState& y) const {
    return margin(at, y, kind_ == Kind::rigid_gap && contact_ != 0 ? slope(at, y) : BodyState{});
}

double Body::margin(double at, const BodyState& y, const BodyState& slope) const {
    double least = std::numeric_limits<double>::infinity();
    if (directional_ && slide_ != 0) least = slide_ * y.v;
    if (directional_ && slide_ == 0) {
        const Acting on = acting(at, y);
        const double load = on_friction(y, on);
        least = std::min(level(1, 0, on) - load, load + level(-1, 0, on));
    }
    if (kind_ == Kind::rigid_gap || kind_ == Kind::sprung_gap)
        least = std::min(least, gap_margin(y, slope));
    return least;
}

// The load has reached a face: both go on with one velocity.
void Body::collide(BodyState& y) {
    contact_ = y.p > 0 ? 1 : -1;
    y.p = contact_ * half_gap_;
    const double motor = motor_ * wave(y.x), load = load_ * wave(y.x - y.p);
    y.v = y.w = (motor * y.v + load * y.w) / (motor + load);
    if (directional_) set_slide(y.v > 0 ? 1 : y.v < 0 ? -1 : 0, y);
    if (slide_ == 0) contact_ = 0;
}

void Body::break_away(double at, const BodyState& y) {
    const Acting on = acting(at, y);
    const double load = on_friction(y, on);
    set_slide(load > level(1, 0, on) ? 1 : load < -level(-1, 0, on) ? -1 : 0, y);
}

void Body::leave_mode(double at, BodyState& y) {
    const bool gap = kind_ == Kind::rigid_gap;
    // Here and not at the next step's beginning: read from there the torque may be a rounding less.
    if (directional_ && slide_ == 0) break_away(at, y);
    if (gap && contact_ != 0 && pressing(y, slope(at, y)) < 0) contact_ = 0;
    if (backwards(y)) {
        y.v = 0;
        if (gap && contact_ != 0) y.w = 0, contact_ = 0;
        set_slide(0, y);
    }
    // Closing, that is; at the moment of parting the load is still at its face.
    if (gap && contact_ == 0 && std::abs(y.p) > half_gap_) {
        if (y.p * (y.v - y.w) > 0)
            collide(y);
        else
            y.p = std::copysign(half_gap_, y.p);
    }
}

void Body::enter_mode(double at, BodyState& y) {
    if (directional_ && slide_ == 0) break_away(at, y);
    if (kind_ == Kind::sprung_gap) contact_ = y.p > half_gap_ ? 1 : y.p < -half_gap_ ? -1 : 0;
    if (kind_ != Kind::rigid_gap) return;
    if (contact_ != 0 && pressing(y, slope(at, y)) < 0) contact_ = 0;
    if (contact_ != 0 || slide_ == 0 || std::abs(y.p) < half_gap_ || y.v != y.w) return;
    // At a face, with no speed between them: does the motor press against it?
    const BodyState parted = slope(at, y);
    if (y.p * (parted.v - parted.w) > 0) contact_ = y.p > 0 ? 1 : -1;
}

} // namespace servoid
