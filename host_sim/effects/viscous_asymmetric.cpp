// Viscous friction with one coefficient for each direction (a screw, a seal, a worm gear).
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <limits>

namespace servoid {
namespace {

class ViscousAsymmetric : public Effect {
    const EffectInfo& info() const override {
        constexpr double inf = std::numeric_limits<double>::infinity();
        static const EffectInfo info = {
            .name = "viscous_asymmetric",
            .title = "viscous friction that depends on the direction",
            .law = "D₊·v for v > 0, D₋·v for v < 0",
            .signature = "residual proportional to |v|: a slope that differs between directions",
            .reference = "Janot, Gautier, Brunot, Data Set and Reference Models of EMPS, 2019",
            .parameters = {{"coefficient_forward", Quantity::viscous, 0, inf,
                            "torque per velocity while v > 0"},
                           {"coefficient_reverse", Quantity::viscous, 0, inf,
                            "torque per velocity while v < 0"}},
            .replaces = {"viscous"},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"coefficient_forward", 1.25e-4},
                                       {"coefficient_reverse", 0.25e-4}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.viscous_forward += term.at("coefficient_forward");
        axis.viscous_reverse += term.at("coefficient_reverse");
    }

    int linear_count(const EffectTerm&) const override { return 2; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        Eigen::MatrixXd columns(motion.size(), 2);
        columns.col(0) = motion.velocity.cwiseMax(0.0);
        columns.col(1) = motion.velocity.cwiseMin(0.0);
        return columns;
    }

    // More one way by what is less the other way.
    Hiding hide(Draw& draw) const override {
        const Scenery& s = draw.scenery();
        const double base = s.viscous > 0 ? s.viscous : draw.torque() / s.top_speed;
        const double sign = draw.sign();
        return {.at =
                    [=, this](double by) {
                        return with({{"coefficient_forward", base * (1 + sign * by)},
                                     {"coefficient_reverse", base * (1 - sign * by)}});
                    },
                .start = 0.3,
                .most = 0.9};
    }
};

} // namespace

const Effect& viscous_asymmetric_effect() {
    static const ViscousAsymmetric effect;
    return effect;
}

} // namespace servoid
