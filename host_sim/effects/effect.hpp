// The seam of the catalogue: one class, one file per physical effect.
//
// An effect says what it is (info), what it does to a simulated axis (add_to), and which torque it
// needs along a measured motion (columns). To add one: copy the shortest file of this folder, and
// add its line to catalogue.cpp. Nothing else knows any effect by name.
#pragma once

#include "model/model.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace servoid {

struct AxisDescription; // host_sim/plant/axis.hpp: what the simulator integrates

// The physical quantity of a parameter; its unit follows from the axis being rotary or linear.
enum class Quantity {
    torque, viscous, inertia, position, velocity, frequency, ratio, angle, per_rev, time, stiffness,
    quadratic_drag, acceleration
};
// ampere: the torque is known as a current only.
std::string unit_of(Quantity quantity, Motion motion, bool ampere = false);

struct ParameterInfo {
    std::string key;
    Quantity quantity;
    double lower, upper; // inclusive; infinities where physics sets no bound
    std::string meaning;
};

struct EffectInfo {
    std::string name;
    std::string law;       // as text, in T, θ, v, a, t
    std::string signature; // what the residual looks like where this effect is missing
    std::string reference; // literature
    std::vector<ParameterInfo> parameters;
    std::vector<std::string> replaces; // effects that cannot stand beside this one
    std::vector<std::string> needs;    // effects without which this one has no meaning
    bool rotary_only = false;
    bool repeatable = false; // may be an array of tables
};

// A measured motion on a uniform grid, before the band limit: the arguments of every law.
struct MotionView {
    Eigen::VectorXd time_s, position, velocity, acceleration;
    double sample_time_s = 0;
    double velocity_noise = 0; // standard deviation of the noise of velocity, rad/s or m/s
    Eigen::Index size() const { return velocity.size(); }
};

// A fitted parameter.
struct Estimate {
    double value = 0;
    double std = 0;
};

class Effect {
  public:
    virtual ~Effect() = default;
    virtual const EffectInfo& info() const = 0;

    // Writes this effect into the axis that the simulator integrates.
    virtual void add_to(AxisDescription& axis, const EffectTerm& term) const = 0;

    // How many coefficients enter the torque linearly, and one column of torque per coefficient
    // (rows: motion.size()). The torque the motor must give on top of J·a is columns · linear(term).
    virtual int linear_count() const = 0;
    virtual Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const = 0;

    // Changes the torque that accelerates the inertia (an elastic load, an inertia that varies with
    // position): on entry J = 1 times the acceleration, on return the torque for J = 1.
    virtual void shape_inertia(const EffectTerm&, const MotionView&, Eigen::VectorXd&) const {}

    // Coefficients <-> parameters, where they are not simply the parameters in the order of info().
    virtual Eigen::VectorXd linear(const EffectTerm& term) const;
    virtual void set_linear(EffectTerm& term, const Eigen::VectorXd& coefficients) const;
};

} // namespace servoid
