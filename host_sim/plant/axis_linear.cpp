// The exact engine: an axis that is linear between two events, its input constant.
#include "plant/axis_engine.hpp"

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace servoid {

namespace {

constexpr int kHalvings = 24;
constexpr double kShortestLag = 1e-6; // of a step; what is shorter is none

// x' = A x + B u over h, u constant: x(h) = phi x + gamma u, for h, h/2, h/4, ...
template <int N, int Inputs> struct Flow {
    using Matrix = Eigen::Matrix<double, N, N>;
    using Input = Eigen::Matrix<double, N, Inputs>;
    std::array<Matrix, kHalvings + 1> phi;
    std::array<Input, kHalvings + 1> gamma;

    Flow() = default;
    Flow(const Matrix& a, const Input& b, double step_s) {
        constexpr int all = N + Inputs;
        for (int k = 0; k <= kHalvings; ++k) {
            Eigen::Matrix<double, all, all> augmented = Eigen::Matrix<double, all, all>::Zero();
            augmented.template topLeftCorner<N, N>() = a;
            augmented.template topRightCorner<N, Inputs>() = b;
            augmented *= step_s * std::ldexp(1.0, -k);
            const Eigen::Matrix<double, all, all> e = augmented.exp();
            phi[size_t(k)] = e.template topLeftCorner<N, N>();
            gamma[size_t(k)] = e.template topRightCorner<N, Inputs>();
        }
    }
};

// State: position, velocity; for eq. (7) the two states q of the flexible part,
//   q1' = ωr q2,  q2' = −ωr q1 − 2ζrωr q2 + ωr d·u,  acceleration = d·u + c0·q1 + c1·q2,
// which is (1/J)(ωr²/ωa²)(s²+2ζaωas+ωa²)/(s²+2ζrωrs+ωr²) written as a direct part d and a rest; and
// with a lag d·(delivered torque). The input is d·u and q is an acceleration too, so that all
// entries are of the order of ωr: in other units the matrix exponential loses six digits.
//
// A dead time delays the asked torque before the lag, which for these two is the same as after it;
// where it is not a whole number of steps, each step is two: before and after the change arrives.
template <bool Elastic, bool Lag> class LinearEngine : public Axis::Engine {
    static constexpr int N = 2 + 2 * Elastic + Lag, kInputs = 1 + Lag, kLast = N - 1;
    using Flows = Flow<N, kInputs>;
    using Matrix = typename Flows::Matrix;
    using Input = typename Flows::Input;
    using Vector = Eigen::Matrix<double, N, 1>;

    struct Piece {
        size_t late = 0; // how many steps ago its torque was asked for
        double step_s = 0;
        Flows forward, reverse, held;
    };

  public:
    LinearEngine(const AxisDescription& axis, double step_s) : axis_(axis) {
        set_flexible_part();
        const double late = axis.drive.dead_time_s / step_s;
        double whole = std::floor(late), part = late - whole;
        if (part > 1 - 1e-9) whole += 1, part = 0;
        if (part > 1e-9)
            add_piece(size_t(whole) + 1, part * step_s);
        else
            part = 0;
        add_piece(size_t(whole), (1 - part) * step_s);
        asked_.assign(pieces_.front().late + 1, 0.0);
    }

    void step(double torque) override {
        ask(torque);
        x_[0] = position, x_[1] = velocity;
        sign_ = stuck ? 0 : velocity > 0 ? 1 : velocity < 0 ? -1 : 0;
        for (const Piece& piece : pieces_) {
            piece_ = &piece;
            torque_ = asked_[piece.late];
            advance_watchfully();
        }
        position = x_[0], velocity = x_[1];
        stuck = sign_ == 0;
    }

    void reset() override {
        x_.setZero();
        std::fill(asked_.begin(), asked_.end(), 0.0);
    }

  private:
    void ask(double torque) {
        const DriveChain& drive = axis_.drive;
        if (drive.limit > 0) torque = std::clamp(torque, -drive.limit, drive.limit);
        if (asked_.size() > 1)
            asked_.pop_back(), asked_.push_front(torque * drive.gain);
        else
            asked_.front() = torque * drive.gain;
    }

    void add_piece(size_t late, double step_s) {
        pieces_.push_back({late, step_s, flow(axis_.viscous_forward, step_s),
                           flow(axis_.viscous_reverse, step_s), held_flow(step_s)});
    }

    void set_flexible_part() {
        direct_ = 1 / axis_.inertia;
        if constexpr (Elastic) {
            const ElasticLoad& e = *axis_.elastic;
            const double wa = e.antiresonance_rad_s, wr = e.resonance_rad_s;
            direct_ = wr * wr / (wa * wa) / axis_.inertia;
            rest_[0] = (wa * wa - wr * wr) / (wr * wr);
            rest_[1] = 2 * (e.antiresonance_damping * wa - e.resonance_damping * wr) / wr;
        }
    }

    Flows flow(double viscous, double step_s) const {
        Matrix a = Matrix::Zero();
        Input b = Input::Zero();
        a(0, 1) = 1;
        a(1, 1) = -direct_ * viscous;
        b(1, 0) = 1;
        if constexpr (Elastic) {
            const ElasticLoad& e = *axis_.elastic;
            const double wr = e.resonance_rad_s;
            a(1, 2) = rest_[0], a(1, 3) = rest_[1];
            a(2, 3) = wr;
            a(3, 1) = -wr * direct_ * viscous;
            a(3, 2) = -wr, a(3, 3) = -2 * e.resonance_damping * wr;
            b(3, 0) = wr;
        }
        if constexpr (Lag) {
            a.col(kLast) = b.col(0);
            add_lag(a, b);
        }
        return Flows(a, b, step_s);
    }

    // Motor held: acceleration = 0 asks for d·u = −(c0 q1 + c1 q2), and the load rings on alone.
    Flows held_flow(double step_s) const {
        Matrix a = Matrix::Zero();
        Input b = Input::Zero();
        if constexpr (Elastic) {
            const ElasticLoad& e = *axis_.elastic;
            const double wr = e.resonance_rad_s;
            a(2, 3) = wr;
            a(3, 2) = -wr - wr * rest_[0];
            a(3, 3) = -2 * e.resonance_damping * wr - wr * rest_[1];
        }
        if constexpr (Lag) add_lag(a, b);
        return Flows(a, b, step_s);
    }

    void add_lag(Matrix& a, Input& b) const {
        a(kLast, kLast) = -1 / axis_.drive.lag_s;
        b(kLast, kInputs - 1) = 1 / axis_.drive.lag_s;
    }

    // What friction has to hold back while the motor stands still.
    double load_on_friction() const {
        double load = (Lag ? x_[kLast] / direct_ : torque_) - axis_.constant_torque;
        if constexpr (Elastic) load += (rest_[0] * x_[2] + rest_[1] * x_[3]) / direct_;
        return load;
    }

    int breakaway() const {
        const double load = load_on_friction();
        return load > axis_.coulomb_forward ? 1 : load < -axis_.coulomb_reverse ? -1 : 0;
    }

    // advance() sees an event by its sign at the end. What rings or lags can come and go on the
    // way, so where the velocity is not far from zero the step is taken in eighths.
    void advance_watchfully() {
        if constexpr (N > 2) {
            const double speed = std::abs(x_[1]);
            const Vector before = x_;
            if (sign_ != 0) {
                const Vector change = propagate(0) - before;
                // Twice what changed, and what the flexible part and the lag can add.
                const double swing = x_.template tail<N - 2>().cwiseAbs().sum() * piece_->step_s;
                if (2 * std::abs(change[1]) + swing < speed) return;
                x_ = before;
            }
            for (int i = 0; i < 8; ++i)
                advance(3);
        } else {
            advance(0);
        }
    }

    // Advances by step/2^k, halving wherever the sign of the friction changes on the way.
    void advance(int k) {
        if (sign_ == 0) sign_ = breakaway();
        const Vector before = x_;
        const int sign_before = sign_;
        propagate(k);
        const bool event = sign_ == 0 ? breakaway() != 0 : sign_ * x_[1] < 0;
        if (!event) return;
        if (k == kHalvings) return settle();
        x_ = before;
        sign_ = sign_before;
        advance(k + 1);
        advance(k + 1);
    }

    // At an event that has been located: stick, break away, or slide on the other way.
    void settle() {
        const int away = breakaway();
        if (sign_ == 0 || away == 0) x_[1] = 0;
        sign_ = away == 0 || x_[1] == 0 ? away : (x_[1] > 0 ? 1 : -1);
    }

    const Vector& propagate(int k) {
        const size_t i = size_t(k);
        const Flows& flows = sign_ > 0   ? piece_->forward
                             : sign_ < 0 ? piece_->reverse
                                         : piece_->held;
        const double friction = sign_ > 0   ? axis_.coulomb_forward
                                : sign_ < 0 ? -axis_.coulomb_reverse
                                            : 0.0;
        double force = -axis_.constant_torque - friction;
        if constexpr (!Lag) force += torque_;
        Vector next = flows.phi[i] * x_ + flows.gamma[i].col(0) * (direct_ * force);
        if constexpr (Lag) next += flows.gamma[i].col(kInputs - 1) * (direct_ * torque_);
        x_ = next;
        return x_;
    }

    AxisDescription axis_;
    double direct_ = 0;
    std::array<double, 2> rest_{};
    std::vector<Piece> pieces_; // of a step, in time
    const Piece* piece_ = nullptr;
    std::deque<double> asked_; // newest first
    Vector x_ = Vector::Zero();
    double torque_ = 0;
    int sign_ = 0;
};

} // namespace

bool is_linear(const AxisDescription& axis) {
    const bool gap = axis.backlash && axis.backlash->width > 0 &&
                     (axis.elastic || axis.backlash->load_share > 0);
    const bool bristle = axis.bristle && axis.bristle->stiffness > 0 && axis.bristle->torque > 0;
    const bool wave = axis.inertia_wave && axis.inertia_wave->fraction != 0;
    return !gap && !bristle && !wave && axis.load_friction == 0 && axis.sliding_extra.empty() &&
           axis.opposing.empty() && !axis.friction_factor && axis.drive.ripple.empty();
}

std::unique_ptr<Axis::Engine> make_linear_engine(const AxisDescription& axis, double step_s) {
    const bool lag = axis.drive.lag_s > kShortestLag * step_s;
    if (axis.elastic && lag) return std::make_unique<LinearEngine<true, true>>(axis, step_s);
    if (axis.elastic) return std::make_unique<LinearEngine<true, false>>(axis, step_s);
    if (lag) return std::make_unique<LinearEngine<false, true>>(axis, step_s);
    return std::make_unique<LinearEngine<false, false>>(axis, step_s);
}

} // namespace servoid
