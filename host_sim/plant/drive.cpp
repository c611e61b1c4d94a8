#include "plant/drive.hpp"

#include "common/error.hpp"
#include "common/scaled.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

constexpr double kTorqueUnits = 1 << 20;
constexpr double kFinestTurn = 1 << 22; // counts of an encoder that the model does not name

const Controller& controller_of(const Model& model) {
    if (!model.controller)
        throw UsageError("the model has no [controller], and nothing can be driven without one");
    return *model.controller;
}

double per_count_of(const Model& model) {
    if (model.sensor.position_per_count > 0) return model.sensor.position_per_count;
    return (model.motion == Motion::rotary ? 2 * std::numbers::pi : 1.0) / kFinestTurn;
}

// The core holds ±8 times its rated torque.
double full_torque_of(const Model& model, const DriveOptions& options) {
    if (model.drive.rated_torque > 0) return model.drive.rated_torque;
    if (model.drive.torque_limit > 0) return model.drive.torque_limit / 4;
    if (options.full_torque > 0) return options.full_torque;
    return controller_of(model).speed_gain * controller_of(model).position_gain_per_s;
}

sid_loop_config_t loop_config(const Model& model, double per_count, double full_torque) {
    const Controller& c = controller_of(model);
    sid_loop_config_t config{};
    config.position_gain = to_scaled(c.position_gain_per_s * c.sample_time_s);
    config.speed_gain = to_scaled(c.speed_gain * per_count / c.sample_time_s / full_torque);
    config.integral_gain =
        to_scaled(c.type == Controller::Type::p_pi ? c.sample_time_s / c.integral_time_s : 0);
    const double limit = model.drive.torque_limit > 0 ? model.drive.torque_limit / full_torque : 8;
    config.torque_limit_pu_q20 =
        int32_t(std::min(std::lround(limit * kTorqueUnits), (1L << 23) - 1));
    config.speed_average = uint8_t(c.speed_average);
    return config;
}

} // namespace

AxisDescription axis_of(const Model& model) {
    AxisDescription axis;
    axis.kind = model.motion;
    axis.inertia = model.inertia;
    for (const EffectTerm& term : model.effects) {
        const Effect* effect = find_effect(term.name);
        if (!effect) throw Error(ExitCode::defect, "no such effect: " + term.name);
        effect->add_to(axis, term);
    }
    return axis;
}

SimulatedDrive::SimulatedDrive(const Model& model, const DriveOptions& options)
    : SimulatedDrive(model, options, axis_of(model)) {}

SimulatedDrive::SimulatedDrive(const Model& model, const DriveOptions& options,
                               const AxisDescription& axis)
    : sample_time_s_(controller_of(model).sample_time_s), per_count_(per_count_of(model)),
      full_torque_(full_torque_of(model, options)), sensor_error_(axis.sensor_error),
      axis_(axis, sample_time_s_),
      torque_per_count_(controller_of(model).speed_gain * per_count_ / sample_time_s_),
      random_(options.seed), noise_(0, std::max(options.torque_noise, 1e-300)),
      noisy_(options.torque_noise > 0), position_noise_(options.position_noise),
      position_random_(~options.seed) {
    const sid_loop_config_t config = loop_config(model, per_count_, full_torque_);
    if (!sid_loop_init(&loop_, &config))
        throw UsageError("the loop's gains are outside what the fixed-point loop can hold "
                         "(position gain times sample time must be at most 1)");
    read();
    sid_loop_reset(&loop_, 0);
}

int32_t SimulatedDrive::counts() const {
    double position = axis_.position();
    if (sensor_error_) position += sensor_error_(position);
    // An axis that has run away stays at the end of the counter.
    constexpr double limit = 2147483647.0;
    const double counted = std::floor((position + reading_noise_) / per_count_ + 0.5);
    return int32_t(std::fmax(-limit, std::fmin(counted, limit)));
}

void SimulatedDrive::read() {
    if (position_noise_ > 0) reading_noise_ = position_noise_ * unit_noise_(position_random_);
}

void SimulatedDrive::set_state(double position, double velocity) {
    for (int k = 4; k >= 1; --k) {
        axis_.set_state(position - k * sample_time_s_ * velocity, velocity);
        if (k == 4)
            sid_loop_reset(&loop_, counts());
        else
            sid_loop_step(&loop_, counts() * 256, counts());
    }
    axis_.set_state(position, velocity);
    loop_.sum_q32 = 0;
}

void SimulatedDrive::set_first_torque(double reference, double torque) {
    if (loop_.integral_gain == 0) return;
    sid_loop_t ahead = loop_;
    const double now =
        sid_loop_step(&ahead, to_q8(reference), counts()) / kTorqueUnits * full_torque_;
    loop_.sum_q32 += std::llround(std::ldexp((torque - now) / torque_per_count_, 32));
}

DriveSample SimulatedDrive::step_q8(int32_t reference_q8) {
    DriveSample out;
    out.counts = counts();
    out.position = out.counts * per_count_;
    out.reference = reference_q8 * per_count_ / 256;
    out.torque_pu_q20 = sid_loop_step(&loop_, reference_q8, out.counts);
    out.torque = out.torque_pu_q20 / kTorqueUnits * full_torque_;
    axis_.step(noisy_ ? out.torque + noise_(random_) : out.torque);
    read();
    return out;
}

int32_t SimulatedDrive::to_q8(double reference) const {
    constexpr double limit = 2147483647.0;
    return int32_t(std::lround(std::clamp(reference / per_count_ * 256, -limit, limit)));
}

DriveSample SimulatedDrive::step(double reference) {
    DriveSample out = step_q8(to_q8(reference));
    out.reference = reference;
    return out;
}

} // namespace servoid
