// Cogging: a torque that the magnets or the screw repeat over the way.
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class Cogging : public OrderEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "cogging",
            .title = "cogging",
            .law = "A·sin(nθ + φ)",
            .signature = "residual a sine of position, whatever the speed",
            .reference = "Holtz, Springob, IEEE TIE 43, 1996",
            .parameters = {{"amplitude", Quantity::torque, 0, kInf, "of the sine"},
                           {"order", Quantity::per_rev, 1e-9, kInf,
                            "cycles per revolution; per metre or `period` in m on a linear axis"},
                           {"phase", Quantity::angle, -kInf, kInf, "at position zero"}},
            .replaces = {},
            .needs = {},
            .repeatable = true,
            .picture = {.against = Against::position,
                        .move = "trapezoid:velocity=40,acceleration=1500,cycles=3",
                        .parameters = {{"amplitude", 5e-3}, {"order", 6.0}, {"phase", 0.0}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double a = term.at("amplitude"), phase = term.at("phase");
        const double k = wave_number(cycles_of(term), axis.kind);
        axis.opposing.push_back(
            [=](const AxisPoint& p) { return a * std::sin(k * p.position + phase); });
    }

    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        const double k = wave_number(cycles_of(term), motion.kind);
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = (k * motion.position.array()).sin();
        out.col(1) = (k * motion.position.array()).cos();
        return out;
    }

    OrderScan scan(const Search& search) const override {
        return {search, Eigen::VectorXcd::Ones(search.position.size()), {}};
    }

    double evidence(const Estimates& estimates, const MotionView& motion) const override {
        return whole_order_evidence(estimates, motion);
    }

    Hiding hide(Draw& draw) const override {
        const double order = draw.order(), phase = draw.phase();
        if (order < 2) return {}; // once per revolution is gravity
        return {.at =
                    [=, this](double s) {
                        return with({{"amplitude", s}, {"order", order}, {"phase", phase}});
                    },
                .start = draw.torque()};
    }
};

} // namespace

const Effect& cogging_effect() {
    static const Cogging effect;
    return effect;
}

} // namespace servoid
