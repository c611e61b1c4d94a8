// Hard stop: a stiff end of the travel on either side.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

double beyond(double position, double stop) {
    return position > stop ? position - stop : position < -stop ? position + stop : 0.0;
}

class HardStop : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "hard_stop",
            .title = "a hard stop",
            .law = "k·(θ ∓ θs) beyond ±θs",
            .signature = "residual only at the ends of the travel, growing with the way beyond",
            .reference = "Brogliato, Nonsmooth Mechanics, 1999",
            .parameters = {{"position", Quantity::position, 1e-12, kInf,
                            "where the stop begins, both sides of zero"},
                           {"stiffness", Quantity::stiffness, 0, kInf, "torque per way beyond it"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::position,
                        .move = "sine:frequency_Hz=3,amplitude=3,periods=4",
                        .parameters = {{"position", 2.0}, {"stiffness", 0.02}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double stop = term.at("position"), k = term.at("stiffness");
        axis.opposing.push_back([=](const AxisPoint& p) { return k * beyond(p.position, stop); });
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        const double stop = term.at("position");
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 1);
        return motion.position.unaryExpr([stop](double p) { return beyond(p, stop); });
    }
    Eigen::VectorXd linear(const EffectTerm& term) const override {
        return Eigen::VectorXd::Constant(1, term.at("stiffness"));
    }
    void set_linear(EffectTerm& term, const Eigen::VectorXd& c) const override {
        term.parameters["stiffness"] = c[0];
    }
    double linear_lower(int) const override { return 0; }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        const double reach = motion.position.cwiseAbs().maxCoeff();
        const double stop = term.at("position");
        return stop > 0.995 * reach || stop < 0.3 * reach ? "no stop within the travel" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"position"}; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        if (search.position.size() == 0) return out;
        const double reach = search.position.cwiseAbs().maxCoeff();
        for (double share : {0.6, 0.75, 0.85, 0.92, 0.97}) {
            EffectTerm term = blank();
            term.parameters["position"] = share * reach;
            out.push_back(term);
        }
        return out;
    }

    Hiding hide(Draw& draw) const override {
        const double reach = draw.scenery().reach();
        const double stop = reach * draw.uniform(0.6, 0.95);
        return {.at =
                    [=, this](double k) {
                        return with({{"position", stop}, {"stiffness", k}});
                    },
                .start = draw.torque() / (0.1 * reach)};
    }
};

} // namespace

const Effect& hard_stop_effect() {
    static const HardStop effect;
    return effect;
}

} // namespace servoid
