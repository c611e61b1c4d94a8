// Stribeck friction: what must be overcome on top of Coulomb friction at low speed.
#include "effects/direction.hpp"
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

constexpr double kFewestRows = 0.01; // share of the rows below the Stribeck speed

class Stribeck : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "stribeck",
            .title = "Stribeck friction",
            .law = "ΔT·exp(−(v/vs)²)·sgn v, on top of Coulomb friction",
            .signature = "residual changes sign with velocity and dies out as |v| grows",
            .reference =
                "Stribeck 1902; Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30, 1994",
            .parameters = {{"extra_torque", Quantity::torque, 0, kInf,
                            "friction at standstill above the sliding friction"},
                           {"velocity", Quantity::velocity, 1e-9, kInf,
                            "speed at which it has fallen to 37 %"}},
            .replaces = {},
            .needs = {"coulomb"},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=1000,cycles=3",
                        .parameters = {{"extra_torque", 6e-3}, {"velocity", 5.0}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double extra = term.at("extra_torque"), vs = term.at("velocity");
        axis.sliding_extra.push_back(
            [=](double speed) { return extra * std::exp(-speed * speed / (vs * vs)); });
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        const double vs = term.at("velocity");
        const Eigen::ArrayXd u = motion.velocity.array() / vs;
        return direction(motion).array() * (-u * u).exp();
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        const double vs = term.at("velocity");
        if (vs > 0.5 * motion.top_speed())
            return "it only bends the viscous line: the speed is above half the top speed";
        if (vs < 2 * motion.velocity_noise) return "it decays within the noise of the velocity";
        const auto slow = (motion.velocity.array().abs() < vs).count();
        return double(slow) < kFewestRows * double(motion.size()) ? "too few rows are that slow"
                                                                  : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"velocity"}; }
    // Above half the top speed it would only bend the viscous line.
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {0.4, 0.15, 0.06, 0.025, 0.01}) {
            EffectTerm term = blank();
            term.parameters["velocity"] = share * search.motion.top_speed();
            if (term.at("velocity") > 2 * search.motion.velocity_noise) out.push_back(term);
        }
        return out;
    }

    Hiding hide(Draw& draw) const override {
        const double speed = draw.scenery().top_speed * draw.log_uniform(0.04, 0.3);
        const double coulomb = draw.scenery().coulomb;
        return {.at =
                    [=, this](double s) {
                        return with({{"extra_torque", s}, {"velocity", speed}});
                    },
                .start = 0.5 * coulomb,
                .most = 3 * coulomb};
    }
};

} // namespace

const Effect& stribeck_effect() {
    static const Stribeck effect;
    return effect;
}

} // namespace servoid
