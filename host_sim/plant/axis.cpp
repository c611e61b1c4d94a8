#include "plant/axis.hpp"

#include "plant/axis_engine.hpp"

#include <stdexcept>

namespace servoid {

namespace {

std::unique_ptr<Axis::Engine> make_engine(const AxisDescription& axis, double step_s) {
    if (!(axis.inertia > 0)) throw std::invalid_argument("axis: the inertia must be positive");
    if (!(step_s > 0)) throw std::invalid_argument("axis: the step must be positive");
    return is_linear(axis) ? make_linear_engine(axis, step_s) : make_general_engine(axis, step_s);
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
    engine_->reset();
}

} // namespace servoid
