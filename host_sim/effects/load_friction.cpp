// Load-dependent friction: what a screw or worm loses grows with the torque through it.
#include "effects/direction.hpp"
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class LoadFriction : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "load_friction",
            .title = "friction that grows with the load",
            .law = "μ·|T|·sgn v, T the delivered torque",
            .signature = "residual changes sign with velocity and grows with the torque",
            .reference = "Dohring, Lee, Newman, ACC 1993; Hamon, Gautier, Garrec, IROS 2010",
            .parameters = {{"coefficient", Quantity::ratio, 0, 0.6,
                            "friction per delivered torque"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::torque,
                        .move = "sine:frequency_Hz=4,amplitude=3,periods=4",
                        .parameters = {{"coefficient", 0.3}},
                        .beside = {}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.load_friction += term.at("coefficient");
    }

    bool uses_torque(const EffectTerm&) const override { return true; }
    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return direction(motion).cwiseProduct(motion.torque.cwiseAbs());
    }
    std::string implausible(const EffectTerm& term, const MotionView&) const override {
        return term.at("coefficient") > 0.6 ? "more than the transmission could lose" : "";
    }

    Hiding hide(Draw&) const override {
        return {.at =
                    [this](double s) {
                        return with({{"coefficient", s}});
                    },
                .start = 0.1,
                .most = 0.5};
    }
};

} // namespace

const Effect& load_friction_effect() {
    static const LoadFriction effect;
    return effect;
}

} // namespace servoid
