#include "effects/catalogue.hpp"

#include <algorithm>

namespace servoid {

// One line per effect: its factory, defined in its own file.
const Effect& viscous_effect();
const Effect& viscous_asymmetric_effect();
const Effect& coulomb_effect();
const Effect& coulomb_asymmetric_effect();
const Effect& constant_torque_effect();
const Effect& elastic_load_effect();

const std::vector<const Effect*>& catalogue() {
    static const std::vector<const Effect*> all = {
        &viscous_effect(),         &viscous_asymmetric_effect(), &coulomb_effect(),
        &coulomb_asymmetric_effect(), &constant_torque_effect(), &elastic_load_effect(),
    };
    return all;
}

const Effect* find_effect(const std::string& name) {
    for (const Effect* effect : catalogue())
        if (effect->info().name == name) return effect;
    return nullptr;
}

std::string cannot_add(const Effect& effect, const Model& model) {
    const EffectInfo& info = effect.info();
    if (info.rotary_only && model.motion == Motion::linear) return "it is for rotary axes only";
    for (const EffectTerm& term : model.effects) {
        if (term.name == info.name && !info.repeatable) return "the model has it already";
        const Effect* present = find_effect(term.name);
        if (!present) continue;
        const auto& replaced = present->info().replaces;
        if (std::find(replaced.begin(), replaced.end(), info.name) != replaced.end())
            return term.name + ", which is in the model, stands for it";
    }
    for (const std::string& needed : info.needs)
        if (!model.find(needed) && !model.find(needed + "_asymmetric"))
            return "it needs " + needed + " in the model";
    return "";
}

Eigen::VectorXd Effect::linear(const EffectTerm& term) const {
    Eigen::VectorXd coefficients(linear_count());
    for (int i = 0; i < linear_count(); ++i) coefficients[i] = term.at(info().parameters[size_t(i)].key);
    return coefficients;
}

void Effect::set_linear(EffectTerm& term, const Eigen::VectorXd& coefficients) const {
    for (int i = 0; i < linear_count(); ++i)
        term.parameters[info().parameters[size_t(i)].key] = coefficients[i];
}

} // namespace servoid
