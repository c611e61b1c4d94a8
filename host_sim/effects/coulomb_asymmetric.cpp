// Coulomb friction with one torque for each direction. With a constant torque free, the same thing
// as symmetric Coulomb friction and that constant torque: the simpler names win.
#include "effects/direction.hpp"
#include "effects/effect.hpp"
#include "plant/axis.hpp"

#include <limits>

namespace servoid {
namespace {

// Never hidden: Coulomb friction and a constant torque explain it on any motion.
class CoulombAsymmetric : public Effect {
    const EffectInfo& info() const override {
        constexpr double inf = std::numeric_limits<double>::infinity();
        static const EffectInfo info = {
            .name = "coulomb_asymmetric",
            .title = "Coulomb friction that depends on the direction",
            .law = "Tc₊ for v > 0, −Tc₋ for v < 0, with sticking",
            .signature = "residual changes sign with velocity, by a different step each way",
            .reference = "Janot, Gautier, Brunot, Data Set and Reference Models of EMPS, 2019",
            .parameters = {{"torque_forward", Quantity::torque, 0, inf,
                            "sliding friction while v > 0"},
                           {"torque_reverse", Quantity::torque, 0, inf,
                            "sliding friction while v < 0"}},
            .replaces = {"coulomb"},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"torque_forward", 8e-3}, {"torque_reverse", 4e-3}},
                        .beside = {"viscous"}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.coulomb_forward += term.at("torque_forward");
        axis.coulomb_reverse += term.at("torque_reverse");
    }

    int linear_count(const EffectTerm&) const override { return 2; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        const Eigen::VectorXd sign = direction(motion);
        Eigen::MatrixXd columns(motion.size(), 2);
        columns.col(0) = sign.cwiseMax(0.0);
        columns.col(1) = sign.cwiseMin(0.0);
        return columns;
    }
};

} // namespace

const Effect& coulomb_asymmetric_effect() {
    static const CoulombAsymmetric effect;
    return effect;
}

} // namespace servoid
