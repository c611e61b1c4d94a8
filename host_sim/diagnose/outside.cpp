#include "diagnose/outside.hpp"

#include "common/error.hpp"
#include "diagnose/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

namespace servoid {

namespace {

constexpr double kAsGood = 1.15; // held-out error over the candidate's

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(const Eigen::VectorXd& x) {
        if (x.size()) low = std::min(low, x.minCoeff()), high = std::max(high, x.maxCoeff());
    }
    double middle() const { return (low + high) / 2; }
    double half() const { return std::max(1e-300, (high - low) / 2); }
};

// A power series of u up to its cube, of which `least` is the first that the model does not have.
EffectTerm cubic(const std::string& u, int least) {
    EffectTerm out;
    out.name = "custom.cubic";
    for (int power = least; power <= 3; ++power) {
        const std::string key = fmt::format("k{}", power);
        out.law += (power > least ? "+" : "") + key;
        if (power > 0) out.law += "*" + u;
        if (power > 1) out.law += fmt::format("^{}", power);
        out.parameters[key] = 0;
    }
    return out;
}

// Which effects may be taken for a bend of the torque over the position, or over the velocity.
bool bends_over_position(const std::string& effect) {
    static const std::set<std::string> all = {"hard_stop", "presliding", "load_friction",
                                              "torque_saturation"};
    return all.contains(effect);
}
bool bends_over_velocity(const std::string& effect) {
    static const std::set<std::string> all = {"quadratic_drag", "stribeck",          "presliding",
                                              "load_friction",  "torque_saturation", "dead_time",
                                              "torque_lag",     "elastic_load"};
    return all.contains(effect);
}

std::vector<EffectTerm> rivals_of(const std::string& effect, const Model& model,
                                  const Assembler& assembler) {
    Range position, velocity;
    for (const MotionView& view : assembler.views())
        position.take(view.position), velocity.take(view.velocity);
    std::vector<EffectTerm> out;
    const std::string u =
        fmt::format("((theta-({:.6g}))/{:.6g})", position.middle(), position.half());
    if (bends_over_position(effect) && position.low < position.high)
        out.push_back(cubic(u, model.find("spring") ? 2 : model.find("constant_torque") ? 1 : 0));
    if (bends_over_velocity(effect))
        out.push_back(cubic(fmt::format("(v/{:.6g})", velocity.half()), 3));
    return out;
}

// artifact: what the method leaves of the model before, or of the candidate.
std::optional<Outside> compare_with(const EffectTerm& term, const Eigen::VectorXd& artifact,
                                    const Diagnosis& d, const Candidate& candidate,
                                    Assembler& assembler) {
    Model model = d.before.model;
    model.effects.push_back(term);
    try {
        assembler.set_artifact(artifact);
        const FitResult rival = fit(model, assembler, going_on_from(d.before));
        const std::vector<double> blocks = held_out_blocks(rival, assembler);
        if (error_of(blocks) > kAsGood * candidate.validation_error_after) return std::nullopt;
        return Outside{term.law, gain_z(candidate.blocks_after, blocks)};
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

} // namespace

std::optional<Outside> outside_rival(const Diagnosis& d, const Candidate& candidate,
                                     Assembler& assembler) {
    std::optional<Outside> best;
    std::vector<Eigen::VectorXd> artifacts = {d.before.artifact};
    const Eigen::VectorXd& after = candidate.fit.artifact;
    if (after.size() != artifacts[0].size() || after != artifacts[0]) artifacts.push_back(after);
    for (const EffectTerm& term : rivals_of(candidate.effect, d.before.model, assembler))
        for (const Eigen::VectorXd& artifact : artifacts) {
            const auto rival = compare_with(term, artifact, d, candidate, assembler);
            if (rival && rival->z > (best ? best->z : kWorse)) best = rival;
        }
    return best;
}

} // namespace servoid
