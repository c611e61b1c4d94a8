// Torque saturation: the drive cannot deliver more than its limit.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// What the torque reaches, but for two instants in a hundred: noise of the acceleration has peaks.
double usual_top(const Eigen::VectorXd& torque) {
    std::vector<double> size;
    for (double t : torque)
        size.push_back(std::abs(t));
    if (size.empty()) return 0;
    const auto at = size.begin() + long(0.98 * double(size.size() - 1));
    std::nth_element(size.begin(), at, size.end());
    return *at;
}

class TorqueSaturation : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "torque_saturation",
            .title = "a limit of the torque",
            .law = "delivered T clipped at ±limit",
            .signature = "residual only where the asked torque is largest",
            .reference = "Leonhard, Control of Electrical Drives, 2001",
            .parameters = {{"limit", Quantity::torque, 1e-12, kInf, "largest torque either way"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::torque,
                        .move = "trapezoid:velocity=60,acceleration=1500,cycles=3",
                        .parameters = {{"limit", 0.015}},
                        .beside = {}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double limit = term.at("limit");
        axis.drive.limit = axis.drive.limit > 0 ? std::min(axis.drive.limit, limit) : limit;
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    void deliver(const EffectTerm& term, TorqueSignal& torque) const override {
        const double limit = term.at("limit");
        torque.samples = torque.samples.cwiseMax(-limit).cwiseMin(limit);
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        return term.at("limit") < 0.4 * usual_top(motion.torque)
                   ? "far below the torque that moved the axis"
                   : "";
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.torque_measured ? "the torque was measured: behind any limit" : "";
    }
    bool delivers() const override { return true; }
    // What is clipped tells nothing any more, noise or not.
    double noise_passed(const EffectTerm& term, const TorqueSignal& asked,
                        const MotionView&) const override {
        const auto free = (asked.samples.array().abs() < term.at("limit")).count();
        return std::sqrt(double(std::max<Eigen::Index>(1, free)) / double(asked.samples.size()));
    }
    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"limit"}; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        const double top = search.torque.cwiseAbs().maxCoeff();
        for (double share : {0.95, 0.85, 0.7, 0.5, 0.25}) {
            EffectTerm term = blank();
            term.parameters["limit"] = share * top;
            out.push_back(term);
        }
        return out;
    }

    // Strength: how much of the largest torque is cut.
    Hiding hide(Draw& draw) const override {
        const double top = draw.scenery().top_torque;
        return {.at =
                    [=, this](double s) {
                        return with({{"limit", top * (1 - s)}});
                    },
                .start = 0.25,
                .least = 0.03,
                .most = 0.6};
    }
};

} // namespace

const Effect& torque_saturation_effect() {
    static const TorqueSaturation effect;
    return effect;
}

} // namespace servoid
