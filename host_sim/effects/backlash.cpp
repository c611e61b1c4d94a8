// Backlash: a gap between motor and load.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// The load inside a gap, dragged along a motion that is given: free between the faces, with the
// motor's speed from the moment a face meets it (a plastic impact). A spring in the faces makes it
// bounce, but how often hangs on less than can be measured: a model of the mean does better.
class DraggedLoad {
  public:
    DraggedLoad(double gap, double position) : half_(gap / 2), position_(position) {}

    double next(double motor, double motor_velocity, double step_s) {
        position_ += velocity_ * step_s;
        if (motor - half_ > position_)
            meet(motor - half_, std::max(velocity_, motor_velocity));
        else if (motor + half_ < position_)
            meet(motor + half_, std::min(velocity_, motor_velocity));
        return velocity_;
    }

  private:
    void meet(double face, double velocity) {
        position_ = face;
        velocity_ = velocity;
    }

    double half_, position_, velocity_ = 0;
};

// The load's velocity at each sample.
Eigen::VectorXd load_velocity(double gap, const MotionView& m) {
    DraggedLoad load(gap, m.position[0]);
    Eigen::VectorXd out(m.size());
    for (Eigen::Index i = 0; i < m.size(); ++i)
        out[i] = load.next(m.position[i], m.velocity[i], m.sample_time_s);
    return out;
}

class Backlash : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "backlash",
            .title = "backlash",
            .law = "load free inside a gap; its share of the inertia acts at either face only",
            .signature =
                "residual in bursts after each change of the torque's sign, where the load "
                "is let go and caught again",
            .reference = "Nordin, Gutman, Automatica 38, 2002; Andoh 2008, section III-F",
            .parameters = {{"gap", Quantity::position, 0, kInf, "play between motor and load"},
                           {"load_share", Quantity::ratio, 0, 0.999,
                            "share of the inertia behind the gap"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::time,
                        .move = "sine:frequency_Hz=4,amplitude=1,periods=2",
                        .parameters = {{"gap", 0.05}, {"load_share", 0.5}},
                        .beside = {},
                        .band_Hz = 300}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.backlash = Gap{term.at("gap"), term.at("load_share")};
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    // The load's share of J times the load's acceleration instead of the motor's.
    void shape_inertia(const EffectTerm& term, const MotionView& motion,
                       Eigen::VectorXd& torque) const override {
        const double share = motion.load_share > 0 ? motion.load_share : term.at("load_share");
        const double gap = term.at("gap");
        if (motion.position.size() < 3 || !(gap > 0) || !(share > 0)) return;
        const Eigen::VectorXd v = load_velocity(gap, motion);
        const double h = motion.sample_time_s;
        for (Eigen::Index i = 1; i + 1 < motion.size(); ++i)
            torque[i] += share * ((v[i + 1] - v[i - 1]) / (2 * h) - motion.acceleration[i]);
    }

    bool shapes_inertia() const override { return true; }
    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        return term.at("gap") > 0.9 * motion.travel() ? "the gap is as wide as the travel" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override {
        return {"gap", "load_share"};
    }
    // The load is caught a sample earlier or not.
    double slope_step() const override { return 0.05; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {0.3, 0.15, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001})
            for (double load : {0.25, 0.5, 0.8}) {
                EffectTerm term = blank();
                term.parameters["gap"] = share * search.motion.travel();
                term.parameters["load_share"] = load;
                if (search.motion.load_share > 0) { // the elastic load says it
                    if (load != 0.5) continue;
                    term.parameters["load_share"] = search.motion.load_share;
                    term.fixed = {"load_share"};
                }
                if (term.at("gap") > search.motion.position_quantum) out.push_back(term);
            }
        return out;
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.position.size() ? "" : "the position was not recorded";
    }

    Hiding hide(Draw& draw) const override {
        const double share = draw.uniform(0.3, 0.85), travel = draw.scenery().travel();
        return {.at =
                    [=, this](double s) {
                        return with({{"gap", s}, {"load_share", share}});
                    },
                .start = 0.02 * travel,
                .most = 0.3 * travel};
    }
};

} // namespace

const Effect& backlash_effect() {
    static const Backlash effect;
    return effect;
}

} // namespace servoid
