// Torque ripple: the torque constant varies with position.
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class TorqueRipple : public OrderEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "torque_ripple",
            .title = "torque ripple",
            .law = "delivered T·(1 + a·sin(nθ + φ))",
            .signature = "residual a sine of position whose size follows the torque",
            .reference = "Holtz, Springob, IEEE TIE 43, 1996; Mattavelli et al., IEEE TIA 41, 2005",
            .parameters = {{"fraction", Quantity::ratio, 0, 0.6, "of the torque"},
                           {"order", Quantity::per_rev, 1e-9, kInf,
                            "cycles per revolution; per metre or `period` in m on a linear axis"},
                           {"phase", Quantity::angle, -kInf, kInf, "at position zero"}},
            .replaces = {},
            .needs = {},
            .repeatable = true,
            .picture = {.against = Against::position,
                        .move = "trapezoid:velocity=60,acceleration=1000,cycles=3",
                        .parameters = {{"fraction", 0.3}, {"order", 8.0}, {"phase", 0.0}},
                        .beside = {}}};
        return info;
    }

    const char* amplitude_key() const override { return "fraction"; }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double a = term.at("fraction"), phase = term.at("phase");
        const double k = wave_number(cycles_of(term), axis.kind);
        axis.drive.ripple.push_back(
            [=](double position) { return a * std::sin(k * position + phase); });
    }

    bool uses_torque(const EffectTerm&) const override { return true; }
    // T + a T sin(nθ+φ) = needed, so T = needed − a T sin(nθ+φ).
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        const double k = wave_number(cycles_of(term), motion.kind);
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = -motion.torque.array() * (k * motion.position.array()).sin();
        out.col(1) = -motion.torque.array() * (k * motion.position.array()).cos();
        return out;
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        if (term.at("fraction") > 0.6) return "more than the torque itself";
        return OrderEffect::implausible(term, motion);
    }

    OrderScan scan(const Search& search) const override {
        return {search, search.torque.cast<std::complex<double>>(), {}};
    }

    double evidence(const Estimates& estimates, const MotionView& motion) const override {
        return whole_order_evidence(estimates, motion);
    }

    Hiding hide(Draw& draw) const override { return hide_fraction(draw); }
};

} // namespace

const Effect& torque_ripple_effect() {
    static const TorqueRipple effect;
    return effect;
}

} // namespace servoid
