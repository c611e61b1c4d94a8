#include "plant/axis_body.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace servoid {

Body::Body(const AxisDescription& axis, double step_s)
    : chain(axis.drive, step_s), axis_(axis), step_s_(step_s) {
    if (axis_.inertia_wave && !(std::abs(axis_.inertia_wave->fraction) < 1))
        throw std::invalid_argument("axis: the inertia would not stay positive over a turn");
    if (axis_.bristle && !(axis_.bristle->stiffness > 0 && axis_.bristle->torque > 0))
        axis_.bristle.reset();
    directional_ = axis_.coulomb_forward != 0 || axis_.coulomb_reverse != 0 ||
                   axis_.viscous_forward != axis_.viscous_reverse || axis_.load_friction != 0 ||
                   !axis_.sliding_extra.empty() || axis_.bristle;
    set_kind();
}

void Body::set_kind() {
    motor_ = axis_.inertia;
    const bool gap = axis_.backlash && axis_.backlash->width > 0;
    if (gap) half_gap_ = axis_.backlash->width / 2;
    if (axis_.elastic && gap) return set_sprung_gap(*axis_.elastic);
    if (axis_.elastic) return set_flexible_part(*axis_.elastic);
    if (!gap || axis_.backlash->load_share <= 0) return;
    if (!(axis_.backlash->load_share < 1))
        throw std::invalid_argument("axis: nothing is left of the motor in front of the backlash");
    kind_ = Kind::rigid_gap;
    load_ = axis_.inertia * axis_.backlash->load_share;
    motor_ = axis_.inertia - load_;
}

void Body::set_flexible_part(const ElasticLoad& e) {
    kind_ = Kind::flexible;
    const double wa = e.antiresonance_rad_s, wr = e.resonance_rad_s;
    direct_ = wr * wr / (wa * wa) / axis_.inertia;
    rest_ = {(wa * wa - wr * wr) / (wr * wr),
             2 * (e.antiresonance_damping * wa - e.resonance_damping * wr) / wr};
    resonance_ = wr;
    resonance_damping_ = e.resonance_damping;
}

void Body::set_sprung_gap(const ElasticLoad& e) {
    kind_ = Kind::sprung_gap;
    const double wa = e.antiresonance_rad_s, ratio = wa / e.resonance_rad_s;
    if (!(ratio < 1))
        throw std::invalid_argument("axis: behind a backlash the resonance must lie above the "
                                    "antiresonance");
    motor_ = axis_.inertia * ratio * ratio;
    load_ = axis_.inertia - motor_;
    spring_ = wa * wa * load_;
    damper_ = 2 * e.antiresonance_damping * wa * load_;
}

void Body::reset(BodyState& state, double position, double velocity) {
    const bool gap = kind_ == Kind::rigid_gap || kind_ == Kind::sprung_gap;
    state = {position, velocity, 0, gap ? velocity : 0};
    slide_ = !directional_ || velocity > 0 ? 1 : velocity < 0 ? -1 : 0;
    contact_ = 0;
    bristle_torque_ = 0, bristle_position_ = position;
    chain.reset();
}

double Body::factor(double time_s) const {
    return axis_.friction_factor ? std::max(axis_.friction_factor(time_s), 0.0) : 1.0;
}

Body::Acting Body::acting(double at, const BodyState& y, double acceleration) const {
    AxisPoint point{double(period_) * step_s_ + at, y.x, y.v, chain.delivered(at, y.x),
                    acceleration};
    Acting out{point.torque, point.torque - axis_.constant_torque, factor(point.time_s)};
    for (const auto& law : axis_.opposing)
        out.free -= law(point);
    if (axis_.bristle) out.free -= out.factor * bristle(y.x);
    return out;
}

double Body::bristle(double x) const {
    const double top = slide_ * axis_.bristle->torque;
    if (slide_ == 0) return bristle_torque_;
    const double way = std::max(slide_ * (x - bristle_position_), 0.0);
    return top + (bristle_torque_ - top) *
                     std::exp(-axis_.bristle->stiffness * way / axis_.bristle->torque);
}

void Body::set_slide(int slide, const BodyState& y) {
    if (slide == slide_) return;
    if (axis_.bristle) bristle_torque_ = bristle(y.x), bristle_position_ = y.x;
    slide_ = slide;
}

// Of all dry friction, without the viscous part.
double Body::level(int direction, double speed, const Acting& acting) const {
    double dry = direction > 0 ? axis_.coulomb_forward : axis_.coulomb_reverse;
    for (const auto& extra : axis_.sliding_extra)
        dry += extra(speed);
    return acting.factor * dry + axis_.load_friction * std::abs(acting.torque);
}

double Body::friction(double v, const Acting& acting) const {
    const double viscous = slide_ > 0 ? axis_.viscous_forward : axis_.viscous_reverse;
    if (!directional_) return acting.factor * viscous * v;
    return slide_ * level(slide_, std::max(slide_ * v, 0.0), acting) + acting.factor * viscous * v;
}

double Body::wave(double x) const {
    if (!axis_.inertia_wave) return 1;
    const InertiaWave& w = *axis_.inertia_wave;
    return 1 + w.fraction * std::cos(w.order * x + w.phase);
}

double Body::wave_slope(double x) const {
    if (!axis_.inertia_wave) return 0;
    const InertiaWave& w = *axis_.inertia_wave;
    return -w.fraction * w.order * std::sin(w.order * x + w.phase);
}

// What the motor gives to the load through the spring of a sprung gap.
double Body::contact_torque(const BodyState& y) const {
    if (contact_ == 0) return 0;
    const double push = spring_ * (y.p - contact_ * half_gap_) + damper_ * (y.v - y.w);
    return contact_ * push > 0 ? push : 0;
}

// What friction has to hold back where the motor stands still.
double Body::on_friction(const BodyState& y, const Acting& acting) const {
    if (kind_ == Kind::flexible)
        return acting.free + (rest_[0] * y.p + rest_[1] * y.w) * wave(y.x) / direct_;
    return acting.free - contact_torque(y);
}

// `torque`: on the motor, friction already taken off.
BodyState Body::flexible_slope(const BodyState& y, double torque) const {
    const double bent = rest_[0] * y.p + rest_[1] * y.w;
    double input = -bent;
    if (slide_ != 0)
        input = direct_ *
                (torque / wave(y.x) - axis_.inertia * wave_slope(y.x) / wave(y.x) * y.v * y.v / 2);
    const double rate = resonance_ * (input - y.p - 2 * resonance_damping_ * y.w);
    return {y.v, input + bent, resonance_ * y.w, rate};
}

BodyState Body::gap_slope(const BodyState& y, double torque) const {
    const double x_load = y.x - y.p;
    const double motor = motor_ * wave(y.x), load = load_ * wave(x_load);
    const double on_motor = torque - motor_ * wave_slope(y.x) * y.v * y.v / 2;
    const double on_load = -load_ * wave_slope(x_load) * y.w * y.w / 2;
    BodyState out{y.v, 0, y.v - y.w, 0};
    if (kind_ == Kind::rigid_gap && contact_ != 0) {
        out.v = out.w = (on_motor + on_load) / (motor + load);
        out.p = 0;
        return out;
    }
    const double between = contact_torque(y);
    if (slide_ != 0) out.v = (on_motor - between) / motor;
    out.w = (on_load + between) / load;
    return out;
}

BodyState Body::slope(double at, const BodyState& y) const {
    if (axis_.reads_acceleration && slide_ != 0) return solved_slope(at, y);
    return slope_with(at, y, 0);
}

// The acceleration at which the laws that depend on it lead to just that acceleration, by secants:
// one step where they are linear in it.
BodyState Body::solved_slope(double at, const BodyState& y) const {
    constexpr int most = 60;
    constexpr double enough = 1e-12;
    double before = 0, guess = slope_with(at, y, before).v;
    double gap_before = guess;
    const double size = std::abs(guess);
    for (int i = 0; i < most; ++i) {
        const BodyState out = slope_with(at, y, guess);
        const double gap = out.v - guess;
        if (std::abs(gap) <= enough * (size + std::abs(guess))) return out;
        const double next = guess - gap * (guess - before) / (gap - gap_before);
        before = guess, gap_before = gap, guess = next;
    }
    if (!std::isfinite(y.v)) return {y.v, y.v, 0, 0};
    throw Error(ExitCode::refused,
                "a law that depends on the acceleration cannot be solved for it at t = " +
                    format_number(double(period_) * step_s_ + at) +
                    " s: no acceleration leads to itself");
}

BodyState Body::slope_with(double at, const BodyState& y, double acceleration) const {
    if (slide_ == 0 && kind_ == Kind::rigid) return {};
    double torque = 0;
    if (slide_ != 0) {
        const Acting on = acting(at, y, acceleration);
        torque = on.free - friction(y.v, on);
    }
    if (kind_ == Kind::flexible) return flexible_slope(y, torque);
    if (kind_ != Kind::rigid) return gap_slope(y, torque);
    const double a = torque / axis_.inertia - wave_slope(y.x) * y.v * y.v / 2;
    return {y.v, a / wave(y.x), 0, 0};
}

double Body::velocity_of(const BodyState& e) const {
    double sum = std::abs(e.v);
    if (kind_ == Kind::flexible) return sum + (std::abs(e.p) + std::abs(e.w)) / resonance_;
    if (kind_ != Kind::rigid) sum += std::abs(e.w) + std::abs(e.p) / step_s_;
    return sum;
}

} // namespace servoid
