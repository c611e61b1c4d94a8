#include "studio/actions.hpp"

#include "common/error.hpp"
#include "diagnose/add_effect.hpp"
#include "effects/catalogue.hpp"
#include "effects/custom_argument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace servoid::studio {

namespace {

// A parameter of a model by its full name.
struct Place {
    double* value = nullptr;
    std::vector<std::string>* fixed = nullptr; // of its term; nullptr: the inertia
    std::string key;
    double lower = 0, upper = INFINITY;
};

Place place_of(Model& model, const std::string& name) {
    if (name == "inertia") return {&model.inertia, nullptr, name};
    for (size_t i = 0; i < model.effects.size(); ++i) {
        EffectTerm& term = model.effects[i];
        for (const ParameterInfo& p : find_effect(term.name)->parameters(term))
            if (term_name(model, i) + "." + p.key == name)
                return {&term.parameters[p.key], &term.fixed, p.key, p.lower, p.upper};
    }
    throw UsageError("there is no parameter " + name + " among the terms that are on");
}

void refuse_twice(const Model& model, const std::string& name) {
    if (model.find(name)) throw UsageError(name + " is in the model already");
}

} // namespace

StepPtr add(const Step& from, const std::string& effect) {
    Step next = from;
    next.what = "+ " + effect;
    return with_fit(std::move(next),
                    add_effect(from.model, effect, from.material->motions()).after);
}

StepPtr add_law(const Step& from, const std::string& name, const std::string& law) {
    const EffectTerm term = parse_custom("custom." + name + "=" + law);
    refuse_twice(from.model, term.name);
    Step next = from;
    next.what = "+ " + term.name;
    return with_fit(std::move(next), add_term(from.model, term, from.material->motions()).after);
}

StepPtr remove(const Step& from, size_t index) {
    Step next = from;
    const size_t on = next.model.effects.size();
    if (index >= on + next.off.size()) throw UsageError("there is no such term");
    if (index >= on) { // it took part in nothing
        const auto term = next.off.begin() + long(index - on);
        next.what = "- " + term->name;
        next.off.erase(term);
        return std::make_shared<const Step>(std::move(next));
    }
    next.what = "- " + next.model.effects[index].name;
    next.model.effects.erase(next.model.effects.begin() + long(index));
    return fitted(std::move(next));
}

StepPtr turn(const Step& from, size_t index, bool on) {
    Step next = from;
    const size_t count = next.model.effects.size();
    if (index >= count + next.off.size() || on != (index >= count))
        throw UsageError("there is no such term that is " + std::string(on ? "off" : "on"));
    if (on) {
        const auto term = next.off.begin() + long(index - count);
        const std::string why = cannot_add(*find_effect(term->name), next.model);
        if (!why.empty()) throw UsageError(term->name + " cannot be turned on: " + why);
        next.what = term->name + " on";
        next.model.effects.push_back(*term);
        next.off.erase(term);
    } else {
        next.what = next.model.effects[index].name + " off";
        next.off.push_back(next.model.effects[index]);
        next.model.effects.erase(next.model.effects.begin() + long(index));
    }
    return fitted(std::move(next));
}

StepPtr set(const Step& from, const std::string& name, double value) {
    Step next = from;
    const Place place = place_of(next.model, name);
    const bool good = std::isfinite(value) && value >= place.lower && value <= place.upper &&
                      (name != "inertia" || value > 0);
    if (!good)
        throw UsageError(fmt::format("{} cannot be {:.6g}: expected {:.6g} … {:.6g}", name, value,
                                     place.lower, place.upper));
    *place.value = value;
    next.what = fmt::format("{} = {:.4g}", name, value);
    return as_it_is(std::move(next));
}

StepPtr fix(const Step& from, const std::string& name, bool fixed) {
    Step next = from;
    const Place place = place_of(next.model, name);
    if (!place.fixed)
        next.model.inertia_fixed = fixed;
    else if (const auto at = std::find(place.fixed->begin(), place.fixed->end(), place.key);
             fixed && at == place.fixed->end())
        place.fixed->push_back(place.key);
    else if (!fixed && at != place.fixed->end())
        place.fixed->erase(at);
    next.what = name + (fixed ? " fixed" : " free");
    return as_it_is(std::move(next));
}

StepPtr fit_again(const Step& from) {
    Step next = from;
    next.what = "fit";
    return fitted(std::move(next));
}

StepPtr with_material(const Step& from, std::shared_ptr<const Material> material,
                      const std::string& what) {
    Step next = from;
    next.warnings = warnings_of(from.model, *material);
    next.material = std::move(material);
    next.what = what;
    return from.fit ? fitted(std::move(next)) : as_it_is(std::move(next));
}

StepPtr diagnosed(const Step& from, const DiagnoseOptions& options) {
    Step next = from;
    auto d =
        std::make_shared<const Diagnosis>(diagnose(from.model, from.material->motions(), options));
    // What is shown is what was judged: the model with every number fitted.
    next.model = d->before.model;
    next.fit = d->before;
    next.torque_error = d->before.torque_error;
    next.diagnosis = std::move(d);
    return std::make_shared<const Step>(std::move(next));
}

StepPtr refined(const Step& from, const DiagnoseOptions& options) {
    auto r = std::make_shared<const Refinement>(
        refine(from.model, from.material->motions(), {}, options));
    Step next = from;
    std::string added;
    for (const Rung& rung : r->ladder)
        if (!rung.added.empty()) added += (added.empty() ? "+ " : ", ") + rung.added;
    next.what = added.empty() ? "refine: nothing to add" : added;
    next.model = r->result.model;
    next.fit = r->result;
    next.torque_error = r->result.torque_error;
    next.diagnosis = std::make_shared<const Diagnosis>(r->last);
    next.refinement = std::move(r);
    return std::make_shared<const Step>(std::move(next));
}

} // namespace servoid::studio
