#include "compare/add_effect.hpp"

#include "common/error.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

void remove_replaced(Model& model, const EffectInfo& info) {
    std::erase_if(model.effects, [&](const EffectTerm& term) {
        return std::find(info.replaces.begin(), info.replaces.end(), term.name) !=
               info.replaces.end();
    });
}

} // namespace

Addition add_effect(const Model& model, const std::string& name,
                    const std::vector<PreparedMotion>& motions) {
    const Effect* effect = find_effect(name);
    if (!effect) throw UsageError("no effect is called " + name + "; see: servoid effects");
    if (const std::string why = cannot_add(*effect, model); !why.empty())
        throw UsageError(name + " cannot be added: " + why);
    if (effect->linear_count() == 0)
        throw UsageError(name + " cannot be fitted from the torque view yet; write it into the "
                                "model with its parameters");
    Addition out;
    out.before = fit(model, motions);
    Model larger = out.before.model;
    remove_replaced(larger, effect->info());
    EffectTerm term;
    term.name = name;
    for (const ParameterInfo& p : effect->info().parameters)
        term.parameters[p.key] = std::isfinite(p.lower) ? p.lower : 0.0;
    larger.effects.push_back(term);
    out.after = fit(larger, motions);
    return out;
}

} // namespace servoid
