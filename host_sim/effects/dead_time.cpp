// Dead time: the torque comes later than it was asked for.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class DeadTime : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "dead_time",
            .title = "dead time",
            .law = "delivered T after a delay",
            .signature =
                "residual in proportion to the change of torque; phase that grows with frequency",
            .reference = "Andoh 2008, section III-F",
            .parameters = {{"delay", Quantity::time, 0, 1, "from asked to delivered"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::quadrature,
                        .move = "multisine:from_Hz=3,to_Hz=90,step_Hz=3,amplitude=0.3,periods=8",
                        .parameters = {{"delay", 1e-3}},
                        .beside = {}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.drive.dead_time_s += term.at("delay");
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    void deliver(const EffectTerm& term, TorqueSignal& torque) const override {
        torque.delay_s += term.at("delay");
    }

    bool delivers() const override { return true; }
    // A slow one smooths the noise of the torque instead, and looks better for it.
    std::string implausible(const EffectTerm& term, const MotionView&) const override {
        return term.at("delay") > 0.05 ? "no drive answers that late" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"delay"}; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {0.2, 0.08, 0.02}) {
            EffectTerm term = blank();
            term.parameters["delay"] = share / search.motion.band_Hz;
            out.push_back(term);
        }
        return out;
    }

    Hiding hide(Draw& draw) const override {
        const double band = draw.scenery().band_Hz;
        return {.at =
                    [this](double s) {
                        return with({{"delay", s}});
                    },
                .start = 0.05 / band,
                .least = 20e-6,
                .most = 0.4 / band};
    }
};

} // namespace

const Effect& dead_time_effect() {
    static const DeadTime effect;
    return effect;
}

} // namespace servoid
