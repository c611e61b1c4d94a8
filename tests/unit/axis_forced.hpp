// The engine for every effect, also where the exact one would do.
#pragma once

#include "plant/axis_engine.hpp"

#include <memory>

namespace servoid {

class Forced {
  public:
    explicit Forced(const AxisDescription& a, const GeneralOptions& options = {},
                    double step_s = 125e-6)
        : engine_(make_general_engine(a, step_s, options)) {}
    void set_state(double position, double velocity) {
        engine_->position = position, engine_->velocity = velocity;
        engine_->stuck = velocity == 0;
        engine_->reset();
    }
    void step(double torque) { engine_->step(torque); }
    double position() const { return engine_->position; }
    double velocity() const { return engine_->velocity; }
    bool stuck() const { return engine_->stuck; }

  private:
    std::unique_ptr<Axis::Engine> engine_;
};

} // namespace servoid
