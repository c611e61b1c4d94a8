// Effects that are a sine of something: two linear coefficients instead of amplitude and phase.
//
//   A·sin(x + φ) = (A cos φ)·sin x + (A sin φ)·cos x
#pragma once

#include "effects/effect.hpp"
#include "effects/hiding.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace servoid {

constexpr double kTurn = 2 * std::numbers::pi;

class WaveEffect : public Effect {
  public:
    int linear_count(const EffectTerm&) const override { return 2; }
    double linear_lower(int) const override { return -std::numeric_limits<double>::infinity(); }

    Eigen::VectorXd linear(const EffectTerm& term) const override {
        const double a = term.at(amplitude_key()), phase = term.at("phase");
        return Eigen::Vector2d(a * std::cos(phase), a * std::sin(phase));
    }
    void set_linear(EffectTerm& term, const Eigen::VectorXd& c) const override {
        term.parameters[amplitude_key()] = std::hypot(c[0], c[1]);
        term.parameters["phase"] = std::atan2(c[1], c[0]);
    }

    // Amplitude and phase share two coefficients: neither stays where one of them moves.
    bool linear_fixed(const EffectTerm& term, int) const override {
        return term.is_fixed(amplitude_key()) || term.is_fixed("phase");
    }

  protected:
    virtual const char* amplitude_key() const { return "amplitude"; }
};

// Orders are per revolution of a rotary motor and per metre of a linear one; κ is in rad per unit
// of position.
inline double wave_number(double order, Motion kind) {
    return kind == Motion::rotary ? order : order * kTurn;
}
inline double order_of(double wave_number, Motion kind) {
    return kind == Motion::rotary ? wave_number : wave_number / kTurn;
}

// Cycles per revolution or per metre of a term. On a linear axis a term may hold the length of a
// cycle, `period` in m, in place of `order`.
double cycles_of(const EffectTerm& term);

// Orders (as κ) at which `pair(κ, i)` = {sine-like, cosine-like} weights explain most of the
// residual: local maxima of the explained power over the band of κ that the travel can resolve and
// the speed lets through. Strongest first, at most `most`.
struct OrderScan {
    const Search& search;
    // Multiplies exp(iκθ) at instant i: real part and imaginary part of the weight, and one more
    // weight that is multiplied by κ (the v² terms of an inertia that varies).
    Eigen::VectorXcd weight, weight_kappa;
};
std::vector<double> strongest_orders(const OrderScan& scan, int most);

// At least this many cycles in the travel, or an order is only a bend.
constexpr double kFewestCycles = 1.5;

// A sine of position whose order is searched for: cogging, ripple, an inertia that varies.
class OrderEffect : public WaveEffect {
  public:
    std::vector<ParameterInfo> parameters(const EffectTerm& term) const override;
    std::vector<std::string> shape_keys(const EffectTerm& term) const override;
    double phase_per_position(const EffectTerm& term, Motion kind) const override;
    double search_price() const override { return 5; }
    std::vector<EffectTerm> starts(const Search& search) const override;
    std::string implausible(const EffectTerm& term, const MotionView& motion) const override;

  protected:
    virtual OrderScan scan(const Search& search) const = 0;
    // A secret whose depth is a share of something, at an order that the motion shows.
    Hiding hide_fraction(Draw& draw) const;
    // Whole orders are the machine's own; a line anywhere else is a little less likely so.
    double whole_order_evidence(const Estimates& estimates, const MotionView& motion) const;
};

} // namespace servoid
