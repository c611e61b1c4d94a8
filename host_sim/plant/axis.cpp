#include "plant/axis.hpp"

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

#include <array>
#include <stdexcept>

namespace servoid {

class Axis::Engine {
  public:
    virtual ~Engine() = default;
    virtual void step(double torque) = 0;
    double position = 0, velocity = 0;
    bool stuck = true;
    virtual void reset_load() = 0;
};

namespace {

constexpr int kHalvings = 24;

// x' = A x + b u over h, u constant: x(h) = phi x + gamma u, for h, h/2, h/4, ...
template <int N> struct Flow {
    using Matrix = Eigen::Matrix<double, N, N>;
    using Vector = Eigen::Matrix<double, N, 1>;
    std::array<Matrix, kHalvings + 1> phi;
    std::array<Vector, kHalvings + 1> gamma;

    Flow() = default;
    Flow(const Matrix& a, const Vector& b, double step_s) {
        for (int k = 0; k <= kHalvings; ++k) {
            Eigen::Matrix<double, N + 1, N + 1> augmented =
                Eigen::Matrix<double, N + 1, N + 1>::Zero();
            augmented.template topLeftCorner<N, N>() = a;
            augmented.template topRightCorner<N, 1>() = b;
            augmented *= step_s * std::ldexp(1.0, -k);
            const Eigen::Matrix<double, N + 1, N + 1> e = augmented.exp();
            phi[size_t(k)] = e.template topLeftCorner<N, N>();
            gamma[size_t(k)] = e.template topRightCorner<N, 1>();
        }
    }
};

// State: position, velocity, and for eq. (7) the two states q of the flexible part,
//   q1' = ωr q2,  q2' = −ωr q1 − 2ζrωr q2 + ωr d·u,  acceleration = d·u + c0·q1 + c1·q2,
// which is (1/J)(ωr²/ωa²)(s²+2ζaωas+ωa²)/(s²+2ζrωrs+ωr²) written as a direct part d and a rest. The
// input is d·u and q is an acceleration too, so that all entries are of the order of ωr: in other
// units the matrix exponential loses six digits.
template <int N> class LinearEngine : public Axis::Engine {
    using Matrix = Eigen::Matrix<double, N, N>;
    using Vector = Eigen::Matrix<double, N, 1>;

  public:
    LinearEngine(const AxisDescription& axis, double step_s) : axis_(axis) {
        set_flexible_part();
        forward_ = flow(axis.viscous_forward, step_s);
        reverse_ = flow(axis.viscous_reverse, step_s);
        held_ = held_flow(step_s);
    }

    void step(double torque) override {
        torque_ = torque - axis_.constant_torque;
        x_[0] = position, x_[1] = velocity;
        sign_ = stuck ? 0 : velocity > 0 ? 1 : velocity < 0 ? -1 : 0;
        advance(0);
        position = x_[0], velocity = x_[1];
        stuck = sign_ == 0;
    }

    void reset_load() override {
        if constexpr (N == 4) x_.template tail<2>().setZero();
    }

  private:
    void set_flexible_part() {
        if constexpr (N == 4) {
            const ElasticLoad& e = *axis_.elastic;
            const double wa = e.antiresonance_rad_s, wr = e.resonance_rad_s;
            direct_ = wr * wr / (wa * wa) / axis_.inertia;
            rest_[0] = (wa * wa - wr * wr) / (wr * wr);
            rest_[1] = 2 * (e.antiresonance_damping * wa - e.resonance_damping * wr) / wr;
        } else {
            direct_ = 1 / axis_.inertia;
        }
    }

    Flow<N> flow(double viscous, double step_s) const {
        Matrix a = Matrix::Zero();
        Vector b = Vector::Zero();
        a(0, 1) = 1;
        a(1, 1) = -direct_ * viscous;
        b[1] = 1;
        if constexpr (N == 4) {
            const ElasticLoad& e = *axis_.elastic;
            const double wr = e.resonance_rad_s;
            a(1, 2) = rest_[0], a(1, 3) = rest_[1];
            a(2, 3) = wr;
            a(3, 1) = -wr * direct_ * viscous;
            a(3, 2) = -wr, a(3, 3) = -2 * e.resonance_damping * wr;
            b[3] = wr;
        }
        return Flow<N>(a, b, step_s);
    }

    // Motor held: acceleration = 0 asks for d·u = −(c0 q1 + c1 q2), and the load rings on alone.
    Flow<N> held_flow(double step_s) const {
        Matrix a = Matrix::Zero();
        if constexpr (N == 4) {
            const ElasticLoad& e = *axis_.elastic;
            const double wr = e.resonance_rad_s;
            a(2, 3) = wr;
            a(3, 2) = -wr - wr * rest_[0];
            a(3, 3) = -2 * e.resonance_damping * wr - wr * rest_[1];
        }
        return Flow<N>(a, Vector::Zero(), step_s);
    }

    // What friction has to hold back while the motor stands still.
    double load_on_friction() const {
        if constexpr (N == 4) return torque_ + (rest_[0] * x_[2] + rest_[1] * x_[3]) / direct_;
        return torque_;
    }

    int breakaway() const {
        const double load = load_on_friction();
        return load > axis_.coulomb_forward ? 1 : load < -axis_.coulomb_reverse ? -1 : 0;
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

    void propagate(int k) {
        const size_t i = size_t(k);
        if (sign_ > 0)
            x_ = forward_.phi[i] * x_ + forward_.gamma[i] * (direct_ * (torque_ - axis_.coulomb_forward));
        else if (sign_ < 0)
            x_ = reverse_.phi[i] * x_ + reverse_.gamma[i] * (direct_ * (torque_ + axis_.coulomb_reverse));
        else
            x_ = held_.phi[i] * x_;
    }

    AxisDescription axis_;
    double direct_ = 0;
    std::array<double, 2> rest_{};
    Flow<N> forward_, reverse_, held_;
    Vector x_ = Vector::Zero();
    double torque_ = 0;
    int sign_ = 0;
};

std::unique_ptr<Axis::Engine> make_engine(const AxisDescription& axis, double step_s) {
    if (!(axis.inertia > 0)) throw std::invalid_argument("axis: the inertia must be positive");
    if (!(step_s > 0)) throw std::invalid_argument("axis: the step must be positive");
    if (axis.elastic) return std::make_unique<LinearEngine<4>>(axis, step_s);
    return std::make_unique<LinearEngine<2>>(axis, step_s);
}

} // namespace

Axis::Axis(const AxisDescription& description, double step_s)
    : engine_(make_engine(description, step_s)) {}
Axis::~Axis() = default;
Axis::Axis(Axis&&) noexcept = default;
Axis& Axis::operator=(Axis&&) noexcept = default;

void Axis::step(double torque) { engine_->step(torque); }
double Axis::position() const { return engine_->position; }
double Axis::velocity() const { return engine_->velocity; }
bool Axis::stuck() const { return engine_->stuck; }

void Axis::set_state(double position, double velocity) {
    engine_->position = position;
    engine_->velocity = velocity;
    engine_->stuck = velocity == 0;
    engine_->reset_load();
}

} // namespace servoid
