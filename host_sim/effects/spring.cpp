// Spring: a torque in proportion to the way from a rest position.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class Spring : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "spring",
            .title = "a spring",
            .law = "k·(θ − θ₀)",
            .signature = "residual proportional to position",
            .reference = "Hooke 1678",
            .parameters = {{"stiffness", Quantity::stiffness, 0, kInf, "torque per way"},
                           {"rest_position", Quantity::position, -kInf, kInf, "where it is slack"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::position,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"stiffness", 3e-3}, {"rest_position", 3.0}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double k = term.at("stiffness"), rest = term.at("rest_position");
        axis.opposing.push_back([=](const AxisPoint& p) { return k * (p.position - rest); });
    }

    bool depends_on_model(const EffectTerm&) const override { return true; }
    int linear_count(const EffectTerm&) const override { return 2; }
    // Beside a constant torque the place of rest says nothing new, and stays as it is.
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        Eigen::MatrixXd out(motion.size(), 2);
        const double rest = motion.has_constant ? term.at("rest_position") : 0;
        out.col(0) = motion.position.array() - rest;
        out.col(1).setConstant(motion.has_constant ? 0 : 1);
        return out;
    }

    bool may_vanish(int index) const override { return index == 1; }
    double linear_lower(int index) const override { return index == 0 ? 0 : -kInf; }
    Eigen::VectorXd linear(const EffectTerm& term) const override {
        return Eigen::Vector2d(term.at("stiffness"),
                               -term.at("stiffness") * term.at("rest_position"));
    }
    void set_linear(EffectTerm& term, const Eigen::VectorXd& c) const override {
        term.parameters["stiffness"] = c[0];
        if (std::isnan(c[1])) return;
        term.parameters["rest_position"] = c[0] > 0 ? -c[1] / c[0] : 0.0;
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.position.size() ? "" : "the position was not recorded";
    }

    Hiding hide(Draw& draw) const override {
        const Scenery& s = draw.scenery();
        const double rest = draw.uniform(s.lowest, s.highest);
        return {.at =
                    [=, this](double k) {
                        return with({{"stiffness", k}, {"rest_position", rest}});
                    },
                .start = draw.torque() / s.travel()};
    }
};

} // namespace

const Effect& spring_effect() {
    static const Spring effect;
    return effect;
}

} // namespace servoid
