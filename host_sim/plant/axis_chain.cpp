#include "plant/axis_chain.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

// Instants are read this share of a step inside their substep, so that at a border between two
// periods the substep's own side of a jump is meant, whatever the rounding.
constexpr double kInside = 1e-9;

} // namespace

TorqueChain::TorqueChain(const DriveChain& drive, double step_s) : drive_(drive), step_s_(step_s) {
    direct_ = !(drive.lag_s > 0) && !(drive.dead_time_s > 0);
    remembers_motion_ = !direct_ && !drive.ripple.empty();
    const double part = std::fmod(std::max(drive.dead_time_s, 0.0), step_s) / step_s;
    if (part > kInside / 10 && part < 1 - kInside / 10) arrival_ = part * step_s;
}

void TorqueChain::reset() {
    past_.clear();
    trial_ = {};
    asked_ = 0;
}

double TorqueChain::ripple(double position) const {
    double sum = 1;
    for (const auto& share : drive_.ripple)
        sum += share(position);
    return sum;
}

// Seconds from the start of a piece to an instant of the current period.
double TorqueChain::since(const Piece& piece, double at) const {
    return at - piece.start + double(period_ - piece.period) * step_s_;
}

// τu' + u = w for a parabola w: u = w − τw' + τ²w'' and what is left of the start.
double TorqueChain::value(const Piece& p, double t) const {
    const double tau = drive_.lag_s;
    const double w = p.c0 + t * (p.c1 + t * p.c2);
    if (!(tau > 0)) return w;
    const double settled = w - tau * (p.c1 + 2 * p.c2 * t) + 2 * p.c2 * tau * tau;
    const double at_start = p.c0 - tau * p.c1 + 2 * p.c2 * tau * tau;
    return settled + (p.output - at_start) * std::exp(-t / tau);
}

double TorqueChain::last_output() const {
    return past_.empty() ? 0 : value(past_.back(), past_.back().length);
}

void TorqueChain::ask(double torque) {
    if (drive_.limit > 0) torque = std::clamp(torque, -drive_.limit, drive_.limit);
    asked_ = torque * drive_.gain;
    ++period_;
    if (direct_ || remembers_motion_) return;
    const double output = last_output();
    past_.push_back({period_, 0, step_s_, output, asked_, 0, 0});
}

TorqueChain::Piece TorqueChain::piece_of(const Stretch& s) const {
    const double w0 = asked_ * ripple(s.position[0]), wm = asked_ * ripple(s.position[1]),
                 w1 = asked_ * ripple(s.position[2]), h = s.length;
    const double c2 = 2 * (w0 - 2 * wm + w1) / (h * h);
    return {period_, s.at, h, last_output(), w0, (w1 - w0) / h - c2 * h, c2};
}

void TorqueChain::open(const Stretch& predicted) {
    open_ = predicted;
    if (direct_) return;
    // What is older than anything that can still be asked for.
    const double oldest = predicted.at - drive_.dead_time_s;
    while (past_.size() > 1 && since(past_[1], oldest) > 0)
        past_.pop_front();
    if (remembers_motion_) trial_ = piece_of(predicted);
}

void TorqueChain::close(const Stretch& real) {
    if (remembers_motion_) past_.push_back(piece_of(real));
}

double TorqueChain::delivered(double at, double position) const {
    if (direct_) return drive_.ripple.empty() ? asked_ : asked_ * ripple(position);
    const double margin = std::min(kInside * step_s_, open_.length / 2);
    const double then =
        std::clamp(at, open_.at + margin, open_.at + open_.length - margin) - drive_.dead_time_s;
    if (remembers_motion_ && since(trial_, then) >= 0) return value(trial_, since(trial_, then));
    if (past_.empty() || since(past_.front(), then) < 0) return 0;
    size_t i = 0;
    while (i + 1 < past_.size() && since(past_[i + 1], then) >= 0)
        ++i;
    return value(past_[i], since(past_[i], then));
}

} // namespace servoid
