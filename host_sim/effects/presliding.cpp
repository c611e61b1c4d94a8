// Pre-sliding: the contact bends like bristles before it slides (Dahl).
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class Presliding : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "presliding",
            .title = "pre-sliding friction",
            .law = "F with F' = σ·v·(1 − F·sgn v/Tb)",
            .signature = "residual of a hysteresis: after each reversal it grows with the way "
                         "travelled, then is flat",
            .reference =
                "Dahl 1968; Canudas de Wit, Olsson, Åström, Lischinsky, IEEE TAC 40, 1995 (LuGre)",
            .parameters = {{"stiffness", Quantity::stiffness, 1e-12, kInf,
                            "torque per deflection at a reversal"},
                           {"torque", Quantity::torque, 0, kInf, "friction once it slides"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::position,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"stiffness", 1e-2}, {"torque", 6e-3}},
                        .beside = {"viscous"}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.bristle = Bristle{term.at("stiffness"), term.at("torque")};
    }

    int linear_count(const EffectTerm&) const override { return 1; }
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 1);
        const double length = std::max(1e-300, bending_length(term));
        Eigen::VectorXd out(motion.size());
        double state = 0; // F/Tb, relaxes to the direction along the way
        for (Eigen::Index i = 0; i < motion.size(); ++i) {
            const double way = i ? motion.position[i] - motion.position[i - 1] : 0;
            const double to = way > 0 ? 1 : -1;
            if (way != 0) state = to + (state - to) * std::exp(-std::abs(way) / length);
            out[i] = state;
        }
        return out;
    }

    // The coefficient is the torque; the length over which the bristles bend stays as it is.
    Eigen::VectorXd linear(const EffectTerm& term) const override {
        return Eigen::VectorXd::Constant(1, term.at("torque"));
    }
    void set_linear(EffectTerm& term, const Eigen::VectorXd& c) const override {
        const double length = bending_length(term);
        const double torque = std::max(c[0], 1e-300);
        term.parameters["torque"] = torque;
        term.parameters["stiffness"] = torque / length;
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        const double length = bending_length(term);
        if (length > 0.5 * motion.travel()) return "it bends over more than half the travel";
        return length < 0.5 * motion.position_quantum ? "stiffer than the encoder can show" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"stiffness"}; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {0.2, 0.07, 0.025, 0.009, 0.003}) {
            const double length = share * search.motion.travel();
            if (!(length > 2 * search.motion.position_quantum) || !(length > 0)) continue;
            EffectTerm term = blank();
            term.parameters["torque"] = 1;
            term.parameters["stiffness"] = 1 / length;
            out.push_back(term);
        }
        return out;
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.position.size() ? "" : "the position was not recorded";
    }

    Hiding hide(Draw& draw) const override {
        const double length = draw.scenery().travel() * draw.log_uniform(0.01, 0.2);
        return {.at =
                    [=, this](double s) {
                        return with({{"stiffness", s / length}, {"torque", s}});
                    },
                .start = draw.torque()};
    }

  private:
    static double bending_length(const EffectTerm& term) {
        const double torque = term.at("torque");
        return (torque > 0 ? torque : 1) / term.at("stiffness");
    }
};

} // namespace

const Effect& presliding_effect() {
    static const Presliding effect;
    return effect;
}

} // namespace servoid
