// An axis integrated by force, for comparison: semi-implicit Euler steps thousands to a period, dry
// friction and impacts by projection (Moreau), every law written down once more from its formula;
// two step sizes are extrapolated to zero. It shares nothing with the engines but the description.
#pragma once

#include "plant/axis.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace servoid::brute_force {

struct Sample {
    double position = 0, velocity = 0;
};

class Integrator {
  public:
    Integrator(const AxisDescription& a, double period_s, int substeps)
        : a_(a), h_(period_s / substeps), substeps_(substeps) {
        const double dead = a.drive.dead_time_s / h_;
        history_.assign(size_t(std::lround(dead)) + 1, 0.0);
        motor_ = a.inertia;
        if (a.backlash && a.elastic) {
            const double wa = a.elastic->antiresonance_rad_s, wr = a.elastic->resonance_rad_s;
            motor_ = a.inertia * wa * wa / (wr * wr);
        } else if (a.backlash) {
            motor_ = a.inertia * (1 - a.backlash->load_share);
        }
        load_ = a.inertia - motor_;
    }

    void start(double position, double velocity) {
        x_ = load_x_ = position;
        v_ = load_v_ = velocity;
    }

    void period(double asked) {
        for (int i = 0; i < substeps_; ++i)
            substep(asked), t_ += h_;
    }
    Sample sample() const { return {x_, v_}; }

  private:
    double drive(double asked) {
        const DriveChain& c = a_.drive;
        if (c.limit > 0) asked = std::min(std::max(asked, -c.limit), c.limit);
        double share = 1;
        for (const auto& r : c.ripple)
            share += r(x_);
        const double wanted = asked * c.gain * share;
        if (c.lag_s > 0)
            lagged_ += (1 - std::exp(-h_ / c.lag_s)) * (wanted - lagged_);
        else
            lagged_ = wanted;
        history_[head_] = lagged_;
        head_ = (head_ + 1) % history_.size();
        return history_[head_];
    }

    double wave(double x) const {
        if (!a_.inertia_wave) return 1;
        return 1 + a_.inertia_wave->fraction *
                       std::cos(a_.inertia_wave->order * x + a_.inertia_wave->phase);
    }
    double wave_slope(double x) const { return (wave(x + 1e-6) - wave(x - 1e-6)) / 2e-6; }

    void substep(double asked) {
        const double torque = drive(asked);
        const double factor = a_.friction_factor ? a_.friction_factor(t_) : 1;
        double free = torque - a_.constant_torque;
        for (const auto& law : a_.opposing)
            free -= law({t_, x_, v_, torque});
        if (a_.bristle) {
            free -= factor * bristle_;
            const double sign = v_ > 0 ? 1 : v_ < 0 ? -1 : 0;
            bristle_ +=
                h_ * a_.bristle->stiffness * v_ * (1 - bristle_ * sign / a_.bristle->torque);
        }
        free -= factor * v_ * (v_ > 0 ? a_.viscous_forward : a_.viscous_reverse);
        double forward = a_.coulomb_forward, reverse = a_.coulomb_reverse;
        for (const auto& extra : a_.sliding_extra)
            forward += extra(std::abs(v_)), reverse += extra(std::abs(v_));
        forward = factor * forward + a_.load_friction * std::abs(torque);
        reverse = factor * reverse + a_.load_friction * std::abs(torque);
        if (a_.elastic && !a_.backlash)
            flexible(free, forward, reverse);
        else if (a_.backlash)
            gap(free, forward, reverse);
        else
            rigid(free, forward, reverse);
        x_ += h_ * v_;
    }

    // Friction of at most these levels takes the velocity towards zero, not past it.
    static double rubbed(double v, double forward, double reverse) {
        return v > forward ? v - forward : v < -reverse ? v + reverse : 0;
    }

    void rigid(double free, double forward, double reverse) {
        const double inertia = a_.inertia * wave(x_);
        v_ += h_ * (free - a_.inertia * wave_slope(x_) * v_ * v_ / 2) / inertia;
        v_ = rubbed(v_, h_ * forward / inertia, h_ * reverse / inertia);
    }

    void flexible(double free, double forward, double reverse) {
        const double wa = a_.elastic->antiresonance_rad_s, wr = a_.elastic->resonance_rad_s;
        const double za = a_.elastic->antiresonance_damping, zr = a_.elastic->resonance_damping;
        // What acts on the inertia at this angle acts like this on the nominal one.
        const double w = wave(x_), direct = wr * wr / (wa * wa) / a_.inertia;
        free = (free - a_.inertia * wave_slope(x_) * v_ * v_ / 2) / w;
        double bend = free - 2 * zr * wr * bent_v_ - wr * wr * bent_;
        const double before = v_ + h_ * direct * (bend + 2 * za * wa * bent_v_ + wa * wa * bent_);
        v_ = rubbed(before, h_ * direct * forward / w, h_ * direct * reverse / w);
        bend -= (before - v_) / (h_ * direct);
        bent_ += h_ * bent_v_;
        bent_v_ += h_ * bend;
    }

    void gap(double free, double forward, double reverse) {
        const double motor = motor_ * wave(x_), load = load_ * wave(load_x_);
        const double half = a_.backlash->width / 2, apart = x_ - load_x_;
        double between = 0;
        if (a_.elastic) {
            const double wa = a_.elastic->antiresonance_rad_s;
            const double into = apart - std::clamp(apart, -half, half);
            if (into != 0)
                between = wa * wa * load_ * into +
                          2 * a_.elastic->antiresonance_damping * wa * load_ * (v_ - load_v_);
            if (between * into <= 0) between = 0;
        }
        v_ += h_ * (free - between - motor_ * wave_slope(x_) * v_ * v_ / 2) / motor;
        v_ = rubbed(v_, h_ * forward / motor, h_ * reverse / motor);
        load_v_ += h_ * (between - load_ * wave_slope(load_x_) * load_v_ * load_v_ / 2) / load;
        const bool touching = apart * (v_ - load_v_) > 0 && std::abs(apart) >= half;
        if (!a_.elastic && touching) v_ = load_v_ = (motor * v_ + load * load_v_) / (motor + load);
        load_x_ += h_ * load_v_;
    }

    AxisDescription a_;
    double h_;
    int substeps_;
    std::vector<double> history_;
    size_t head_ = 0;
    double motor_ = 0, load_ = 0;
    double t_ = 0, x_ = 0, v_ = 0, load_x_ = 0, load_v_ = 0;
    double bent_ = 0, bent_v_ = 0, lagged_ = 0, bristle_ = 0;
};

// Samples at the end of each period.
inline std::vector<Sample> run(const AxisDescription& a, double period_s,
                               const std::vector<double>& asked, double velocity,
                               int substeps = 1000) {
    std::vector<Sample> out;
    Integrator coarse(a, period_s, substeps), fine(a, period_s, 2 * substeps);
    coarse.start(0, velocity), fine.start(0, velocity);
    for (double torque : asked) {
        coarse.period(torque), fine.period(torque);
        const Sample c = coarse.sample(), f = fine.sample();
        out.push_back({2 * f.position - c.position, 2 * f.velocity - c.velocity});
    }
    return out;
}

} // namespace servoid::brute_force
