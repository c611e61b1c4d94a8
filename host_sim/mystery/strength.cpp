#include "mystery/strength.hpp"

#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/noise.hpp"
#include "compare/regression.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kLeastTravel = 0.7, kMostTravel = 1.4; // of what it was
constexpr double kMostTorque = 2.5;                     // rms, of what it was
constexpr double kMostOff = 0.3;                        // rms of the position's change, of its own

Eigen::ArrayXd as_array(const std::vector<double>& v) {
    return Eigen::Map<const Eigen::ArrayXd>(v.data(), Eigen::Index(v.size()));
}

double travel_of(const Eigen::ArrayXd& x) { return x.maxCoeff() - x.minCoeff(); }

double mean_parameter(const Model& model, const std::string& effect) {
    for (const std::string& name : {effect, effect + "_asymmetric"})
        if (const EffectTerm* term = model.find(name)) {
            double sum = 0;
            for (const auto& [key, value] : term->parameters)
                sum += value;
            return sum / double(term->parameters.size());
        }
    return 0;
}

Scenery scenery_of(const Model& model, const PreparedMotion& m) {
    Scenery s;
    s.kind = model.motion;
    s.lowest = m.motion.position.minCoeff(), s.highest = m.motion.position.maxCoeff();
    s.top_speed = m.motion.top_speed(), s.typical_speed = rms(m.motion.velocity);
    s.top_torque = m.torque.cwiseAbs().maxCoeff();
    s.duration_s = m.capture->time_s.back();
    s.period_s = m.period_s.value_or(0);
    s.band_Hz = m.band_Hz;
    s.viscous = mean_parameter(model, "viscous"), s.coulomb = mean_parameter(model, "coulomb");
    return s;
}

// What `fitted` leaves of the torque. Laws that depend on the rest of a model see that of `truth`.
double left_by(const Model& truth, const Model& fitted,
               const std::vector<PreparedMotion>& motions) {
    Assembler assembler(motions);
    assembler.set_context(truth);
    return linear_error(fitted, assembler);
}

Model with_blank(Model model, const std::string& name, const std::string& parameter) {
    EffectTerm term;
    term.name = name, term.parameters[parameter] = 0;
    model.effects.push_back(term);
    return model;
}

} // namespace

Stage::Stage(const Model& model, const Experiment& experiment, unsigned long noise_seed)
    : model_(model), experiment_(experiment), noise_seed_(noise_seed),
      without_(simulate_run(model, experiment, noise_seed)),
      motions_(prepare_all({&without_.capture, 1}, {})),
      scenery_(scenery_of(model, motions_.front())) {}

Model Stage::refitted(const std::string& but) const {
    Model out = model_;
    for (const auto& [name, key] : {std::pair{"viscous", "coefficient"},
                                    {"coulomb", "torque"},
                                    {"constant_torque", "torque"}}) {
        if (name == but || !cannot_add(*find_effect(name), out).empty()) continue;
        const Model more = with_blank(out, name, key);
        if (std::isfinite(left_by(model_, more, motions_))) out = more;
    }
    return out;
}

bool Stage::healthy(const SimulatedRun& run, const EffectTerm& hidden) const {
    const Eigen::ArrayXd position = as_array(run.capture.position);
    const Eigen::ArrayXd before = as_array(without_.capture.position);
    const Eigen::ArrayXd torque = as_array(run.capture.torque_ref);
    const Eigen::ArrayXd torque_before = as_array(without_.capture.torque_ref);
    if (!position.allFinite() || !torque.allFinite()) return false;
    const double travel = travel_of(position) / travel_of(before);
    if (travel < kLeastTravel || travel > kMostTravel) return false;
    if (rms(torque.matrix()) > kMostTorque * rms(torque_before.matrix())) return false;
    const bool limits = axis_of(with_hidden(model_, hidden)).drive.limit > 0;
    if (run.saturated && !limits && !without_.saturated) return false;
    return rms((position - before).matrix()) < kMostOff * rms((before - before.mean()).matrix());
}

std::optional<Strength> Stage::strength(const EffectTerm& hidden) const {
    const Model truth = with_hidden(model_, hidden);
    const SimulatedRun run = simulate_run(truth, experiment_, noise_seed_);
    if (!healthy(run, hidden)) return std::nullopt;
    const Model known = refitted(hidden.name);
    try {
        const std::vector<PreparedMotion> motions = prepare_all({&run.capture, 1}, {});
        Strength out;
        out.floor = left_by(model_, known, motions_);
        const double left = left_by(model_, known, motions);
        const auto beyond = [&](double error) {
            return std::sqrt(std::max(0.0, error * error - out.floor * out.floor));
        };
        out.share = beyond(left);
        out.unnamed = beyond(left_by(truth, with_hidden(known, hidden), motions));
        out.band_Hz = motions.front().band_Hz;
        return std::isfinite(left) ? std::optional(out) : std::nullopt;
    } catch (const Refusal&) { // it hardly moves
        return std::nullopt;
    }
}

std::string Stage::cannot_show(const EffectTerm& hidden) const {
    Assembler assembler(motions_);
    assembler.set_context(model_);
    const MotionView& view = assembler.views().front();
    const Effect& effect = *find_effect(hidden.name);
    for (const std::string& why : {effect.cannot_show(view), effect.implausible(hidden, view)})
        if (!why.empty()) return why;
    return refusal(hidden);
}

std::string Stage::refusal(const EffectTerm& hidden) const {
    const Capture capture = simulate(with_hidden(model_, hidden), experiment_, noise_seed_);
    try {
        fit(model_, prepare_all({&capture, 1}, {}));
        return "";
    } catch (const Refusal& e) {
        return e.what();
    }
}

} // namespace servoid
