// Torque lag: the current loop follows what it is asked for.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class TorqueLag : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "torque_lag",
            .title = "a lag of the torque",
            .law = "delivered T through 1/(τs + 1)",
            .signature =
                "residual in proportion to the change of torque, largest where the torque jumps",
            .reference = "Andoh 2008, section III-F; Leonhard, Control of Electrical Drives, 2001",
            .parameters = {{"time_constant", Quantity::time, 0, 1, "of the current loop"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::torque_rate,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"time_constant", 5e-4}},
                        .beside = {}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.drive.lag_s = term.at("time_constant");
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    // Exact for a held torque: what comes out, averaged over each hold, is held again. Plain
    // samples are joined by straight lines and come out as samples.
    void deliver(const EffectTerm& term, TorqueSignal& torque) const override {
        const double h = torque.sample_time_s, tau = term.at("time_constant");
        if (!(tau > 0) || torque.samples.size() == 0) return;
        const double keep = std::exp(-h / tau), spread = tau / h * (1 - keep);
        double y = torque.samples[0], before = torque.samples[0];
        for (double& sample : torque.samples) {
            const double u = sample;
            if (torque.held) {
                sample = u + (y - u) * spread;
                y = keep * y + (1 - keep) * u;
            } else {
                y = keep * y + (1 - keep) * before + (1 - spread) * (u - before);
                before = u;
                sample = y;
            }
        }
    }

    bool delivers() const override { return true; }
    // exp(mean over f of ln|1/(1 + 2πjfτ)|). A torque reference is a number without noise.
    double noise_passed(const EffectTerm& term, const TorqueSignal&,
                        const MotionView& motion) const override {
        const double x = 2 * std::numbers::pi * motion.band_Hz * term.at("time_constant");
        if (!motion.torque_measured || !(x > 1e-6)) return 1;
        return std::exp(1 - std::log1p(x * x) / 2 - std::atan(x) / x);
    }
    // A slow one smooths the noise of the torque instead, and looks better for it.
    std::string implausible(const EffectTerm& term, const MotionView&) const override {
        return term.at("time_constant") > 0.05 ? "no drive answers that late" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override {
        return {"time_constant"};
    }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {0.25, 0.08, 0.02}) {
            EffectTerm term = blank();
            term.parameters["time_constant"] = share / search.motion.band_Hz;
            out.push_back(term);
        }
        return out;
    }

    Hiding hide(Draw& draw) const override {
        const double band = draw.scenery().band_Hz;
        return {.at =
                    [this](double s) {
                        return with({{"time_constant", s}});
                    },
                .start = 0.05 / band,
                .least = 20e-6,
                .most = 0.5 / band};
    }
};

} // namespace

const Effect& torque_lag_effect() {
    static const TorqueLag effect;
    return effect;
}

} // namespace servoid
