// Torque gain: the drive delivers more or less than it was asked for.
#include "effects/effect.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Never hidden: inertia and friction take it up.
class TorqueGain : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "torque_gain",
            .title = "a gain of the torque",
            .law = "delivered T·g",
            .signature = "none: inertia and friction take it up, unless one of them is fixed",
            .reference = "Andoh 2008, section III-F",
            .parameters = {{"gain", Quantity::ratio, 1e-3, 1e3, "delivered over asked"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::velocity,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"gain", 0.8}},
                        .refitted = true}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.drive.gain *= term.at("gain");
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    void deliver(const EffectTerm& term, TorqueSignal& torque) const override {
        torque.samples *= term.at("gain");
    }

    bool delivers() const override { return true; }
    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"gain"}; }
    std::vector<EffectTerm> starts(const Search&) const override {
        EffectTerm term = blank();
        term.parameters["gain"] = 1;
        return {term};
    }
};

} // namespace

const Effect& torque_gain_effect() {
    static const TorqueGain effect;
    return effect;
}

} // namespace servoid
