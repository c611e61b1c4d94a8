#include "blind/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double sine(const Wave& w, double x) { return w.amplitude * std::sin(w.number * x + w.phase); }

class Mechanics {
  public:
    Mechanics(const World& w, double step, Start start) : w_(w), h_(step) {
        x_ = load_x_ = start.position;
        v_ = load_v_ = start.velocity;
        motor_ = w.inertia;
        if (w.gap > 0) {
            load_ = w.load_share * w.inertia;
            motor_ = w.inertia - load_;
            stiffness_ = load_ * w.contact_rad_s * w.contact_rad_s;
            damping_ = 2 * w.contact_damping * w.contact_rad_s * load_;
        } else if (w.modes) {
            const double ratio = w.modes->antiresonance / w.modes->resonance;
            motor_ = w.inertia * ratio * ratio;
        }
        delayed_.assign(static_cast<size_t>(std::lround(w.dead_time / step)) + 1, 0.0);
        lag_keep_ = w.lag > 0 ? std::exp(-step / w.lag) : 0;
    }

    double position() const { return x_; }
    double velocity() const { return v_; }
    bool stuck() const { return v_ == 0; }
    double direction() const { return direction_; }
    double delivered() const { return delivered_; }
    double time() const { return t_; }

    // One step under an asked torque and an outside one.
    void step(double asked, double outside) {
        delivered_ = deliver(asked);
        x_ += v_ * h_ / 2;
        load_x_ += load_v_ * h_ / 2;
        mode_ += mode_rate_ * h_ / 2;
        kick(outside);
        x_ += v_ * h_ / 2;
        load_x_ += load_v_ * h_ / 2;
        mode_ += mode_rate_ * h_ / 2;
        t_ += h_;
    }

  private:
    double deliver(double asked) {
        double torque = asked * w_.gain;
        if (w_.delivered_limit > 0)
            torque = std::clamp(torque, -w_.delivered_limit, w_.delivered_limit);
        double factor = 1;
        for (const Wave& wave : w_.ripple)
            factor += sine(wave, x_);
        torque *= factor;
        lagged_ = torque + lag_keep_ * (lagged_ - torque);
        delayed_[head_] = lagged_;
        head_ = head_ + 1 == delayed_.size() ? 0 : head_ + 1;
        return delayed_[head_];
    }

    // Everything that depends on time, place and speed smoothly, as torque against the motor.
    double opposing() const {
        double sum = w_.constant + w_.quadratic * v_ * std::abs(v_) + w_.cubic_drag * v_ * v_ * v_;
        if (w_.gravity != 0) sum += w_.gravity * std::sin(x_ + w_.gravity_phase);
        const double way = x_ - w_.spring_rest;
        sum += w_.spring * way + w_.cubic_spring * way * way * way;
        if (w_.stop_stiffness > 0) {
            if (x_ > w_.stop_position) sum += w_.stop_stiffness * (x_ - w_.stop_position);
            if (x_ < -w_.stop_position) sum += w_.stop_stiffness * (x_ + w_.stop_position);
        }
        for (const Wave& wave : w_.cogging)
            sum += sine(wave, x_);
        if (w_.disturbance != 0)
            sum += w_.disturbance * std::sin(kTurn * w_.disturbance_Hz * t_ + w_.disturbance_phase);
        return sum;
    }

    double bristles(double factor) {
        if (!(w_.bristle_torque > 0)) return 0;
        const double grow = w_.bristle_stiffness * v_ * h_;
        bristle_ = (bristle_ + grow) / (1 + std::abs(grow) / w_.bristle_torque);
        return factor * bristle_;
    }

    // The push of the load on the motor across the gap: a contact presses, it never pulls.
    double contact() const {
        const double apart = x_ - load_x_, half = w_.gap / 2;
        const double rate = damping_ * (v_ - load_v_);
        if (apart > half) return std::max(0.0, stiffness_ * (apart - half) + rate);
        if (apart < -half) return std::min(0.0, stiffness_ * (apart + half) + rate);
        return 0;
    }

    void kick(double outside) {
        const double warm = 1 + (w_.drift == 0 ? 0 : -w_.drift * std::expm1(-t_ / w_.drift_time));
        const double viscous = warm * v_ * (v_ > 0 ? w_.viscous_forward : w_.viscous_reverse);
        const double net = delivered_ + outside - opposing() - viscous - bristles(warm);
        double mass = motor_ * (w_.jump_factor != 1 && t_ >= w_.jump_time ? w_.jump_factor : 1);
        double coupling = 0;
        if (w_.gap > 0)
            coupling = contact();
        else if (w_.modes)
            coupling = mode_push();
        if (w_.inertia_wave.amplitude != 0) {
            const Wave& wave = w_.inertia_wave;
            const double angle = wave.number * x_ + wave.phase;
            coupling -= mass * wave.amplitude * wave.number * std::sin(angle) * v_ * v_ / 2;
            mass *= 1 + wave.amplitude * std::cos(angle);
        }
        const double free = v_ + h_ * (net - coupling) / mass;
        double dry = warm * (free > 0 ? w_.coulomb_forward : w_.coulomb_reverse);
        if (w_.stribeck_extra > 0) {
            const double u = v_ / w_.stribeck_velocity;
            dry += warm * w_.stribeck_extra * std::exp(-u * u);
        }
        dry += w_.load_friction * std::abs(delivered_);
        const double least = h_ * dry / mass;
        double friction = dry;
        if (std::abs(free) <= least) {
            friction = mass * free / h_;
            v_ = 0;
            direction_ = dry > 0 ? friction / dry : 0;
        } else {
            friction = std::copysign(dry, free);
            v_ = free - std::copysign(least, free);
            direction_ = std::copysign(1.0, free);
        }
        if (w_.gap > 0)
            load_v_ += h_ * coupling / load_;
        else if (w_.modes)
            advance_mode(net - friction);
    }

    // Controllable form of eq. (7): q'' + 2ζr ωr q' + ωr² q = T, and
    // J (ωa/ωr)² θ'' = T − 2(ζr ωr − ζa ωa) q' − (ωr² − ωa²) q.
    double mode_push() const {
        const Modes& m = *w_.modes;
        const double a = m.antiresonance, r = m.resonance;
        return 2 * (m.resonance_damping * r - m.antiresonance_damping * a) * mode_rate_ +
               (r * r - a * a) * mode_;
    }
    void advance_mode(double torque) {
        const double r = w_.modes->resonance;
        mode_rate_ +=
            h_ * (torque - 2 * w_.modes->resonance_damping * r * mode_rate_ - r * r * mode_);
    }

    const World& w_;
    double h_, t_ = 0;
    double x_ = 0, v_ = 0, load_x_ = 0, load_v_ = 0, mode_ = 0, mode_rate_ = 0, bristle_ = 0;
    double motor_ = 0, load_ = 0, stiffness_ = 0, damping_ = 0;
    double delivered_ = 0, direction_ = 0, lagged_ = 0, lag_keep_ = 0;
    std::vector<double> delayed_;
    size_t head_ = 0;
};

class Encoder {
  public:
    explicit Encoder(const World& w) : w_(w) {}
    double read(double position) const {
        const double seen = position + w_.eccentricity * std::sin(position + w_.eccentricity_phase);
        return w_.quantum > 0 ? std::floor(seen / w_.quantum + 0.5) * w_.quantum : seen;
    }

  private:
    const World& w_;
};

class Loop {
  public:
    Loop(const World& w, double measured) : w_(w), last_(measured) {}
    double torque(double reference, double measured) {
        const double speed = (measured - last_) / w_.period;
        last_ = measured;
        const double error = w_.position_gain * (reference - measured) - speed;
        double sum = sum_;
        if (w_.integral_time > 0) sum += error * w_.period / w_.integral_time;
        double out = w_.speed_gain * (error + sum);
        if (w_.torque_limit > 0 && std::abs(out) > w_.torque_limit) {
            limited_ = true;
            out = std::copysign(w_.torque_limit, out);
        } else {
            sum_ = sum; // the integral waits while the torque is at its limit
        }
        return out;
    }
    bool limited() const { return limited_; }

  private:
    const World& w_;
    double last_, sum_ = 0;
    bool limited_ = false;
};

// asked(k, measured) → torque of period k.
template <class Ask>
Record simulate(const World& w, size_t periods, Start start, const RunOptions& options, Ask asked) {
    const int n = options.substeps;
    Mechanics axis(w, w.period / n, start);
    const Encoder encoder(w);
    std::mt19937_64 random(options.seed);
    std::normal_distribution<double> normal(0, 1);
    double walk = 0;
    Record r;
    for (size_t k = 0; k < periods; ++k) {
        const double measured = encoder.read(axis.position());
        const double torque = asked(k, measured);
        const double noise = w.torque_noise * normal(random);
        if (w.walk_per_root_s > 0) walk += w.walk_per_root_s * std::sqrt(w.period) * normal(random);
        r.asked.push_back(torque), r.measured.push_back(measured);
        r.position.push_back(axis.position()), r.velocity.push_back(axis.velocity());
        r.noise.push_back(noise);
        double direction = 0, delivered = 0, stuck = 0;
        for (int i = 0; i < n; ++i) {
            axis.step(torque, noise - walk);
            direction += axis.direction(), delivered += axis.delivered();
            stuck += axis.stuck() ? 1 : 0;
        }
        r.direction.push_back(direction / n), r.delivered.push_back(delivered / n);
        r.stuck.push_back(stuck / n);
        r.mean_velocity.push_back((axis.position() - r.position.back()) / w.period);
        r.acceleration.push_back((axis.velocity() - r.velocity.back()) / w.period);
    }
    return r;
}

} // namespace

Record run(const World& w, const Reference& reference, const RunOptions& options) {
    Loop loop(w, Encoder(w).read(0));
    Record r = simulate(w, reference.size(), {}, options, [&](size_t k, double measured) {
        return loop.torque(reference[k], measured);
    });
    r.reference = reference;
    r.limited = loop.limited();
    return r;
}

Record run_open(const World& w, const std::vector<double>& torque, const Start& start,
                const RunOptions& options) {
    return simulate(w, torque.size(), start, options, [&](size_t k, double) { return torque[k]; });
}

} // namespace blind
