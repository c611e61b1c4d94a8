// Coulomb friction: a torque of constant size against the motion, and sticking at rest.
#include "effects/direction.hpp"
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <limits>

namespace servoid {
namespace {

class Coulomb : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "coulomb",
            .title = "Coulomb friction",
            .law = "Tc·sgn v, with sticking",
            .signature = "residual changes sign with velocity and is flat in |v|",
            .reference = "Andoh 2008, section III-A; Coulomb 1785; Armstrong-Hélouvry 1991",
            .parameters = {{"torque", Quantity::torque, 0, std::numeric_limits<double>::infinity(),
                            "sliding friction, both directions"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"torque", 6e-3}},
                        .beside = {"viscous"}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.coulomb_forward += term.at("torque");
        axis.coulomb_reverse += term.at("torque");
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return direction(motion);
    }

    Hiding hide(Draw& draw) const override {
        return {.at = [this](double s) { return with({{"torque", s}}); }, .start = draw.torque()};
    }
};

} // namespace

const Effect& coulomb_effect() {
    static const Coulomb effect;
    return effect;
}

} // namespace servoid
