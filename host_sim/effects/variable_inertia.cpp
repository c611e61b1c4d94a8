// Variable inertia: a crank, an eccentric, a linkage.
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class VariableInertia : public OrderEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "variable_inertia",
            .title = "an inertia that varies with the position",
            .law = "J·(1 + a·cos(nθ + φ))·v' + ½·J'·v²",
            .signature =
                "residual a sine of position whose size follows acceleration and squared speed",
            .reference = "Goldstein, Classical Mechanics; Kakizaki, Otani, Kogure 2002",
            .parameters = {{"fraction", Quantity::ratio, 0, 0.95, "of the inertia"},
                           {"order", Quantity::per_rev, 1e-9, kInf,
                            "cycles per revolution; per metre or `period` in m on a linear axis"},
                           {"phase", Quantity::angle, -kInf, kInf, "at position zero"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::position,
                        .move = "trapezoid:stroke=12.57,velocity=60,acceleration=1000,cycles=3",
                        .parameters = {{"fraction", 0.3}, {"order", 2.0}, {"phase", 0.0}}}};
        return info;
    }

    const char* amplitude_key() const override { return "fraction"; }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.inertia_wave = InertiaWave{term.at("fraction"),
                                        wave_number(cycles_of(term), axis.kind), term.at("phase")};
    }

    bool depends_on_model(const EffectTerm&) const override { return true; }
    // J a cos(x+φ) − ½ J κ sin(x+φ) v², x = κθ, split into cos φ and sin φ.
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        const double k = wave_number(cycles_of(term), motion.kind);
        const Eigen::ArrayXd c = (k * motion.position.array()).cos();
        const Eigen::ArrayXd s = (k * motion.position.array()).sin();
        const Eigen::ArrayXd a = motion.acceleration.array();
        const Eigen::ArrayXd v2 = motion.velocity.array().square() * (k / 2);
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = motion.inertia * (c * a - s * v2);
        out.col(1) = -motion.inertia * (s * a + c * v2);
        return out;
    }

    // exp(iκθ)·(a + iκ v²/2): its real part is the first column, its imaginary part minus the
    // second.
    OrderScan scan(const Search& search) const override {
        const std::complex<double> half_i(0, 0.5);
        return {search, search.acceleration.cast<std::complex<double>>(),
                half_i * search.velocity.cwiseAbs2().cast<std::complex<double>>()};
    }

    Hiding hide(Draw& draw) const override { return hide_fraction(draw); }
};

} // namespace

const Effect& variable_inertia_effect() {
    static const VariableInertia effect;
    return effect;
}

} // namespace servoid
