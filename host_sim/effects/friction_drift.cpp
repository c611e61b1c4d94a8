// Friction drift: grease that warms up, and friction with it.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class FrictionDrift : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "friction_drift",
            .title = "a drift of the friction",
            .law = "all friction × (1 + d·(1 − exp(−t/τ)))",
            .signature = "residual in proportion to friction that fades in or out over the record",
            .reference = "Bittencourt, Gunnarsson, IEEE TIE 59, 2012",
            .parameters = {{"fraction", Quantity::ratio, -0.95, 20,
                            "change of all friction in the long run"},
                           {"time_constant", Quantity::time, 1e-6, kInf, "of the change"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::time,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=6",
                        .parameters = {{"fraction", 0.8}, {"time_constant", 0.5}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double d = term.at("fraction"), tau = term.at("time_constant");
        axis.friction_factor = [=](double t) { return 1 + d * -std::expm1(-t / tau); };
    }

    bool depends_on_model(const EffectTerm&) const override { return true; }
    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        const double tau = term.at("time_constant");
        if (motion.friction.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 1);
        return motion.friction.array() * (1 - (-motion.time_s.array() / tau).exp());
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override {
        return {"time_constant"};
    }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        const double length = search.time_s[search.time_s.size() - 1];
        for (double share : {0.7, 0.3, 0.1, 0.03}) {
            EffectTerm term = blank();
            term.parameters["time_constant"] = share * length;
            out.push_back(term);
        }
        return out;
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.friction.size() && motion.friction.squaredNorm() > 0
                   ? ""
                   : "the model has no friction that could drift";
    }

    Hiding hide(Draw& draw) const override {
        const double tau = draw.scenery().duration_s * draw.log_uniform(0.1, 0.7);
        const double sign = draw.sign();
        return {.at =
                    [=, this](double s) {
                        return with({{"fraction", sign * s}, {"time_constant", tau}});
                    },
                .start = 0.3,
                .most = sign > 0 ? 1.5 : 0.8};
    }
};

} // namespace

const Effect& friction_drift_effect() {
    static const FrictionDrift effect;
    return effect;
}

} // namespace servoid
