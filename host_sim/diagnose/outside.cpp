#include "diagnose/outside.hpp"

#include "common/error.hpp"
#include "diagnose/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace servoid {

namespace {

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

std::optional<EffectTerm> rival_of(const std::string& effect, const Model& model,
                                   const Assembler& assembler) {
    Range position, velocity;
    for (const MotionView& view : assembler.views())
        position.take(view.position), velocity.take(view.velocity);
    if (effect == "hard_stop") {
        const std::string u =
            fmt::format("((theta-({:.6g}))/{:.6g})", position.middle(), position.half());
        return cubic(u, model.find("spring") ? 2 : model.find("constant_torque") ? 1 : 0);
    }
    if (effect == "quadratic_drag" || effect == "stribeck")
        return cubic(fmt::format("(v/{:.6g})", velocity.half()), 3);
    return std::nullopt;
}

} // namespace

std::optional<Outside> outside_rival(const Diagnosis& d, const Candidate& candidate,
                                     Assembler& assembler) {
    const auto term = rival_of(candidate.effect, d.before.model, assembler);
    if (!term) return std::nullopt;
    Model model = d.before.model;
    model.effects.push_back(*term);
    try {
        assembler.set_artifact(candidate.fit.artifact);
        const FitResult rival = fit(model, assembler, going_on_from(d.before));
        const double z = gain_z(candidate.blocks_after, held_out_blocks(rival, assembler));
        if (z < -kTellsApart) return std::nullopt;
        return Outside{term->law, z};
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

} // namespace servoid
