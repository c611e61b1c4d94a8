// Dead time: the torque comes later than it was asked for.
#include "effects/effect.hpp"
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
            .law = "delivered T after a delay",
            .signature =
                "residual in proportion to the change of torque; phase that grows with frequency",
            .reference = "Andoh 2008, section III-F",
            .parameters = {{"delay", Quantity::time, 0, 1, "from asked to delivered"}},
            .replaces = {},
            .needs = {}};
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
};

} // namespace

const Effect& dead_time_effect() {
    static const DeadTime effect;
    return effect;
}

} // namespace servoid
