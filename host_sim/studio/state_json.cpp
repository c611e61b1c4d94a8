#include "studio/state_json.hpp"

#include "effects/catalogue.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace servoid::studio {

namespace {

using Deviations = std::map<std::string, double>;

Deviations deviations_of(const Step& step) {
    Deviations out;
    if (step.fit)
        for (const FittedParameter& p : step.fit->parameters)
            if (!p.fixed) out[p.name] = p.estimate.std;
    return out;
}

Json std_of(const Deviations& deviations, const std::string& name) {
    const auto found = deviations.find(name);
    return found == deviations.end() ? Json(nullptr) : number(found->second);
}

Json inertia_json(const Step& step, const Deviations& deviations, bool ampere) {
    return {{"name", "inertia"},
            {"key", "inertia"},
            {"value", step.model.inertia},
            {"std", std_of(deviations, "inertia")},
            {"unit", unit_of(Quantity::inertia, step.model.motion, ampere)},
            {"fixed", step.model.inertia_fixed},
            {"lower", 0},
            {"upper", nullptr},
            {"meaning", step.model.motion == Motion::rotary ? "moment of inertia" : "mass"}};
}

struct Listed {
    const EffectTerm& term;
    std::string name; // "cogging#2"
    size_t index;
    bool on;
};

Json term_json(const Listed& l, const Step& step, const Deviations& deviations, bool ampere) {
    const Effect& effect = *find_effect(l.term.name);
    Json parameters = Json::array();
    for (const ParameterInfo& p : effect.parameters(l.term)) {
        const std::string name = l.name + "." + p.key;
        parameters.push_back({{"name", name},
                              {"key", p.key},
                              {"value", number(l.term.at(p.key))},
                              {"std", l.on ? std_of(deviations, name) : Json(nullptr)},
                              {"unit", unit_of(p.quantity, step.model.motion, ampere)},
                              {"fixed", l.term.is_fixed(p.key)},
                              {"lower", number(p.lower)},
                              {"upper", number(p.upper)},
                              {"meaning", p.meaning}});
    }
    return {{"index", l.index},
            {"effect", l.name},
            {"law", l.term.law.empty() ? effect.info().law : l.term.law},
            {"on", l.on},
            {"parameters", parameters}};
}

} // namespace

Json terms_json(const Step& step) {
    const bool ampere = step.material->motions().front().capture->torque_in_ampere;
    const Deviations deviations = deviations_of(step);
    Json terms = Json::array();
    const size_t on = step.model.effects.size();
    for (size_t i = 0; i < on; ++i)
        terms.push_back(term_json({step.model.effects[i], term_name(step.model, i), i, true}, step,
                                  deviations, ampere));
    for (size_t i = 0; i < step.off.size(); ++i)
        terms.push_back(
            term_json({step.off[i], step.off[i].name, on + i, false}, step, deviations, ampere));
    return {{"inertia", inertia_json(step, deviations, ampere)}, {"terms", terms}};
}

Json recordings_json(const Recordings& recordings) {
    Json out = Json::array();
    for (const auto& r : recordings)
        out.push_back({{"file", r->capture.path},
                       {"rows", r->capture.rows()},
                       {"duration_s", r->capture.time_s.back() - r->capture.time_s.front()},
                       {"on", r->on}});
    return out;
}

Json effects_json(const Model& model) {
    Json out = Json::array();
    for (const Effect* effect : catalogue()) {
        const EffectInfo& info = effect->info();
        if (info.written) continue;
        out.push_back({{"name", info.name},
                       {"law", info.law},
                       {"signature", info.signature},
                       {"cannot_add", cannot_add(*effect, model)}});
    }
    return out;
}

Json busy_json(const std::optional<Busy>& busy) {
    if (!busy) return nullptr;
    return {{"what", busy->what},
            {"detail", busy->detail},
            {"share", busy->share},
            {"elapsed_s", busy->elapsed_s},
            {"left_s", busy->left_s ? Json(*busy->left_s) : Json(nullptr)}};
}

} // namespace servoid::studio
