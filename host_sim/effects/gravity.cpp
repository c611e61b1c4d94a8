// Gravity on an arm: a torque that goes round with the angle.
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class Gravity : public WaveEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "gravity",
            .title = "gravity",
            .law = "G·sin(θ+φ)",
            .signature = "residual a sine of the angle, once per revolution",
            .reference = "Swevers, Verdonck, De Schutter, IEEE Control Systems 27, 2007",
            .parameters = {{"torque", Quantity::torque, 0, kInf, "of the arm held out"},
                           {"phase", Quantity::angle, -kInf, kInf,
                            "angle of the arm at position zero"}},
            .replaces = {},
            .needs = {},
            .rotary_only = true,
            .picture = {.against = Against::position,
                        .move = "trapezoid:stroke=12.57,velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"torque", 8e-3}, {"phase", 0.0}}}};
        return info;
    }

    const char* amplitude_key() const override { return "torque"; }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double torque = term.at("torque"), phase = term.at("phase");
        axis.opposing.push_back(
            [=](const AxisPoint& p) { return torque * std::sin(p.position + phase); });
    }

    double phase_per_position(const EffectTerm&, Motion) const override { return 1; }

    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = motion.position.array().sin();
        out.col(1) = motion.position.array().cos();
        return out;
    }

    std::string cannot_show(const MotionView& motion) const override {
        if (motion.position.size() == 0) return "the position was not recorded";
        return motion.travel() > 0.3 ? "" : "the move is too short to tell an arc from a line";
    }

    Hiding hide(Draw& draw) const override {
        const double phase = draw.phase();
        return {.at =
                    [=, this](double s) {
                        return with({{"torque", s}, {"phase", phase}});
                    },
                .start = draw.torque()};
    }
};

} // namespace

const Effect& gravity_effect() {
    static const Gravity effect;
    return effect;
}

} // namespace servoid
