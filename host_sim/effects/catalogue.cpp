#include "effects/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid {

// One line per effect: its factory, defined in its own file.
#define SERVOID_EFFECTS(X)                                                                         \
    X(viscous)                                                                                     \
    X(viscous_asymmetric)                                                                          \
    X(coulomb)                                                                                     \
    X(coulomb_asymmetric)                                                                          \
    X(stribeck)                                                                                    \
    X(presliding)                                                                                  \
    X(load_friction)                                                                               \
    X(quadratic_drag)                                                                              \
    X(constant_torque)                                                                             \
    X(gravity)                                                                                     \
    X(spring)                                                                                      \
    X(hard_stop)                                                                                   \
    X(cogging)                                                                                     \
    X(torque_ripple)                                                                               \
    X(torque_gain)                                                                                 \
    X(torque_lag)                                                                                  \
    X(dead_time)                                                                                   \
    X(torque_saturation)                                                                           \
    X(elastic_load)                                                                                \
    X(backlash)                                                                                    \
    X(variable_inertia)                                                                            \
    X(encoder_eccentricity)                                                                        \
    X(periodic_disturbance)                                                                        \
    X(friction_drift)                                                                              \
    X(custom)

#define SERVOID_DECLARE(name) const Effect& name##_effect();
#define SERVOID_LIST(name) &name##_effect(),

SERVOID_EFFECTS(SERVOID_DECLARE)

const std::vector<const Effect*>& catalogue() {
    static const std::vector<const Effect*> all = {SERVOID_EFFECTS(SERVOID_LIST)};
    return all;
}

const Effect* find_effect(const std::string& name) {
    if (name.starts_with("custom.")) return &custom_effect();
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

std::string out_of_bounds(const Model& model) {
    for (const EffectTerm& term : model.effects)
        for (const ParameterInfo& p : find_effect(term.name)->parameters(term))
            if (const double value = term.at(p.key); !(value >= p.lower && value <= p.upper))
                return fmt::format("{}.{} comes out as {:.3g}, possible is {:.3g} to {:.3g}",
                                   term.name, p.key, value, p.lower, p.upper);
    return "";
}

} // namespace servoid
