// Constant torque: gravity on a vertical axis, an offset of the current sensor.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <limits>

namespace servoid {
namespace {

class ConstantTorque : public Effect {
    const EffectInfo& info() const override {
        constexpr double inf = std::numeric_limits<double>::infinity();
        static const EffectInfo info = {
            .name = "constant_torque",
            .title = "a constant torque",
            .law = "w",
            .signature = "residual with a mean that no motion changes",
            .reference = "Andoh 2008, eq. (1)",
            .parameters = {{"torque", Quantity::torque, -inf, inf,
                            "positive where the motor must push forward to stand still"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"torque", 5e-3}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.constant_torque += term.at("torque");
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::VectorXd::Ones(motion.size());
    }

    Hiding hide(Draw& draw) const override {
        const double sign = draw.sign();
        return {.at =
                    [=, this](double s) {
                        return with({{"torque", sign * s}});
                    },
                .start = draw.torque()};
    }
};

} // namespace

const Effect& constant_torque_effect() {
    static const ConstantTorque effect;
    return effect;
}

} // namespace servoid
