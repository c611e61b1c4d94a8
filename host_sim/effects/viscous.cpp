// Viscous friction: torque proportional to velocity.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <limits>

namespace servoid {
namespace {

class Viscous : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "viscous",
            .title = "viscous friction",
            .law = "D·v",
            .signature = "residual proportional to velocity, the same slope in both directions",
            .reference = "Andoh 2008, eq. (1); Armstrong-Hélouvry, Control of Machines with "
                         "Friction, 1991",
            .parameters = {{"coefficient", Quantity::viscous, 0,
                            std::numeric_limits<double>::infinity(),
                            "torque per velocity, both directions"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"coefficient", 2e-4}},
                        .beside = {"coulomb"}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.viscous_forward += term.at("coefficient");
        axis.viscous_reverse += term.at("coefficient");
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return motion.velocity;
    }

    Hiding hide(Draw& draw) const override {
        return {.at =
                    [this](double s) {
                        return with({{"coefficient", s}});
                    },
                .start = draw.torque() / draw.scenery().top_speed};
    }
};

} // namespace

const Effect& viscous_effect() {
    static const Viscous effect;
    return effect;
}

} // namespace servoid
