// The seam of the catalogue: one class, one file per physical effect.
//
// An effect says what it is (info), what it does to a simulated axis (add_to), and which torque it
// needs along a measured motion (columns). To add one: copy the shortest file of this folder, and
// add its line to catalogue.cpp. A few places know effects by name on purpose: what counts as
// friction (compare/assembly.cpp), aliases and rivals (diagnose/).
#pragma once

#include "model/model.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace servoid {

struct AxisDescription; // host_sim/plant/axis.hpp: what the simulator integrates
class Draw;             // effects/hiding.hpp: parameters drawn at random that suit a motion
struct Hiding;

// The physical quantity of a parameter; its unit follows from the axis being rotary or linear.
enum class Quantity {
    torque,
    viscous,
    inertia,
    position,
    velocity,
    frequency,
    ratio,
    angle,
    per_rev,
    time,
    stiffness,
    quadratic_drag,
    acceleration,
    none // the user's own: no unit is known
};
// ampere: the torque is known as a current only.
std::string unit_of(Quantity quantity, Motion motion, bool ampere = false);

struct ParameterInfo {
    std::string key;
    Quantity quantity;
    double lower, upper; // inclusive; infinities where physics sets no bound
    std::string meaning;
};

// What a residual is drawn against.
enum class Against {
    velocity,
    position,
    acceleration,
    time,
    torque,
    torque_rate,
    in_phase,  // frequency: the part of the residual in phase with the torque
    quadrature // frequency: the part a quarter of a turn behind it
};

// The residual that shows an effect best: of a small motor (report/signature.cpp) that has the
// effect and the friction beside it, less a model that knows only that friction.
struct Picture {
    Against against = Against::velocity;
    std::string move; // experiment, see plant/experiment.hpp
    std::map<std::string, double> parameters;
    std::vector<std::string> beside = {"viscous", "coulomb"};
    double band_Hz = 150;
    bool refitted = false; // the model's numbers first: for an effect that hides in them
};

struct EffectInfo {
    std::string name;
    std::string title;     // in a sentence: "Coulomb friction"
    std::string law;       // as text, in T, θ, v, a, t
    std::string signature; // what the residual looks like where this effect is missing
    std::string reference; // literature
    std::vector<ParameterInfo> parameters;
    std::vector<std::string> replaces; // effects that cannot stand beside this one
    std::vector<std::string> needs;    // effects without which this one has no meaning
    bool rotary_only = false;
    bool repeatable = false; // may be an array of tables
    // The user writes its law: never a candidate by itself, and its shapes are start values, not
    // beliefs.
    bool written = false;
    std::string example = {}; // of a model file, where the law is written there
    Picture picture = {};
};

// A measured motion at the sample rate, before the band limit: the arguments of every law.
struct MotionView {
    Eigen::VectorXd time_s, position, velocity, acceleration;
    Eigen::VectorXd torque; // that the model needs: the measured one would explain itself
    double sample_time_s = 0;
    double velocity_noise = 0; // standard deviation of the noise of velocity, rad/s or m/s
    double position_quantum = 0;
    double band_Hz = 0; // upper edge of what is compared later
    Motion kind = Motion::rotary;
    // What the rest of the model says, for effects that change another: refreshed before each fit.
    double inertia = 0, viscous = 0;
    Eigen::VectorXd friction; // torque of all friction of the model
    // The load's share of the inertia where the model has an elastic load, 1 − (ωa/ωr)², and of
    // what it swings on where a backlash stands before it; 0: none.
    double load_share = 0, antiresonance_rad_s = 0, antiresonance_damping = 0;
    bool has_constant = false; // the model has a constant torque: no other effect needs its own
    Eigen::Index size() const { return velocity.size(); }
    bool torque_measured = false; // the torque that acts on the axis, not the one asked for
    double fastest = 0;           // of all captures that are fitted together; 0: of this one
    double top_speed() const { return std::max(fastest, velocity.cwiseAbs().maxCoeff()); }
    double travel() const {
        return position.size() ? position.maxCoeff() - position.minCoeff() : 0;
    }
};

// The asked torque on its way to the motor, at the capture's sample rate.
struct TorqueSignal {
    Eigen::VectorXd samples;
    double sample_time_s = 0;
    bool held = false;  // until the next sample; false: plain samples
    double delay_s = 0; // it acts this much later
};

// What a search for shape parameters may look at: the motion, and the residual of the model without
// the effect on a coarser grid of instants.
struct Search {
    const MotionView& motion;
    const Eigen::VectorXd& time_s; // of the grid
    const Eigen::VectorXd &position, &velocity, &acceleration, &torque, &residual;
};

// A fitted parameter.
struct Estimate {
    double value = 0;
    double std = 0;
};

using Estimates = std::map<std::string, Estimate>; // of one term, by key

class Effect {
  public:
    virtual ~Effect() = default;
    virtual const EffectInfo& info() const = 0;
    // The parameters of a term: info()'s, but where the term brings its own.
    virtual std::vector<ParameterInfo> parameters(const EffectTerm&) const {
        return info().parameters;
    }

    // Writes this effect into the axis that the simulator integrates.
    virtual void add_to(AxisDescription& axis, const EffectTerm& term) const = 0;

    // How many coefficients enter the torque linearly, and one column of torque per coefficient
    // (rows: motion.size()). The torque the motor must give on top of J·a is columns ·
    // linear(term).
    virtual int linear_count(const EffectTerm& term) const = 0;
    virtual Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const = 0;

    // Coefficients <-> parameters, where they are not simply the first of parameters().
    virtual Eigen::VectorXd linear(const EffectTerm& term) const;
    virtual void set_linear(EffectTerm& term, const Eigen::VectorXd& coefficients) const;
    // Coefficients that go without saying where their column is zero (the offset of a spring beside
    // a constant torque): set_linear then sees NaN and leaves their parameters as they are.
    virtual bool may_vanish(int) const { return false; }
    // The least a coefficient may be: the bound of its parameter; −∞ where it is one of a pair.
    virtual double linear_lower(int index) const;
    // Whether no fit changes a coefficient: its parameter is fixed, or it has none.
    virtual bool linear_fixed(const EffectTerm& term, int index) const;

    // Changes the torque that accelerates the inertia (an elastic load, a gap): on entry J = 1
    // times the acceleration, on return the torque for J = 1.
    virtual void shape_inertia(const EffectTerm&, const MotionView&, Eigen::VectorXd&) const {}
    virtual bool shapes_inertia() const { return false; }

    // Changes the asked torque into what reaches the motor (lag, dead time, saturation).
    virtual void deliver(const EffectTerm&, TorqueSignal&) const {}
    virtual bool delivers() const { return false; }
    // The share of the noise of the recorded torque, in amplitude, that it lets through in the
    // band: what smooths or clips the torque takes noise away, and that is no merit (the geometric
    // mean over frequencies or samples: the Jacobian of a transformed response).
    virtual double noise_passed(const EffectTerm&, const TorqueSignal&, const MotionView&) const {
        return 1;
    }

    // Whether the columns depend on the torque.
    virtual bool uses_torque(const EffectTerm&) const { return false; }
    // Whether the columns depend on what the rest of the model says (MotionView's last members).
    virtual bool depends_on_model(const EffectTerm& term) const { return uses_torque(term); }

    // By how many radians its phase turns when the position zero moves by one unit: κ of a wave of
    // the position, whose two coefficients are A cos φ and A sin φ, φ its parameter `phase`. 0:
    // none.
    virtual double phase_per_position(const EffectTerm&, Motion) const { return 0; }

    // Parameters that do not enter linearly, and where a search for them starts (every other
    // parameter of the terms is filled in too). Empty starts: this motion cannot show the effect.
    virtual std::vector<std::string> shape_keys(const EffectTerm&) const { return {}; }
    virtual std::vector<EffectTerm> starts(const Search& search) const;

    // Relative step that shows how the columns move with a shape: larger where they move in jumps.
    virtual double slope_step() const { return 1e-4; }

    // What is known beforehand of the values that were found, as a logarithm of odds: a whole order
    // speaks for a motor, a line of time that follows the turning against a disturbance.
    virtual double evidence(const Estimates&, const MotionView&) const { return 0; }

    // The price of a search, as the logarithm of how many independent places it looked at.
    virtual double search_price() const { return 1.5 * double(shape_keys(blank()).size()); }
    // Why this motion cannot show the effect, in words ("less than one and a half turns"), or "".
    virtual std::string cannot_show(const MotionView&) const { return ""; }

    // Where the law of a term has no finite value on this motion, in words, or "".
    virtual std::string undefined(const EffectTerm&, const MotionView&) const { return ""; }

    // Why a fitted term is another thing than this effect on this motion ("it only bends the
    // viscous line"), or "".
    virtual std::string implausible(const EffectTerm&, const MotionView&) const { return ""; }

    // How to hide this effect in a drive whose motion without it is known; by default it is never
    // hidden (an alias of others, or nothing that one experiment could show).
    virtual Hiding hide(Draw&) const;

  protected:
    EffectTerm blank() const; // name, every parameter at 0 or its nearest bound
    EffectTerm with(std::map<std::string, double> parameters) const;
};

} // namespace servoid
