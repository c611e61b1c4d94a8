// Quadratic drag: a fan, oil that is churned, air.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class QuadraticDrag : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "quadratic_drag",
            .title = "quadratic drag",
            .law = "c·v·|v|",
            .signature = "residual odd in velocity that grows faster than in proportion",
            .reference = "Swevers, Verdonck, De Schutter, IEEE Control Systems 27, 2007",
            .parameters = {{"coefficient", Quantity::quadratic_drag, 0, kInf,
                            "torque per squared velocity"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"coefficient", 4e-6}},
                        .beside = {"coulomb"}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double c = term.at("coefficient");
        axis.opposing.push_back(
            [c](const AxisPoint& p) { return c * p.velocity * std::abs(p.velocity); });
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return motion.velocity.array() * motion.velocity.array().abs();
    }

    Hiding hide(Draw& draw) const override {
        const double top = draw.scenery().top_speed;
        return {.at =
                    [this](double s) {
                        return with({{"coefficient", s}});
                    },
                .start = draw.torque() / (top * top)};
    }
};

} // namespace

const Effect& quadratic_drag_effect() {
    static const QuadraticDrag effect;
    return effect;
}

} // namespace servoid
