#include "effects/effect.hpp"

#include "effects/hiding.hpp"

#include <cmath>
#include <limits>

namespace servoid {

Eigen::VectorXd Effect::linear(const EffectTerm& term) const {
    Eigen::VectorXd coefficients(linear_count());
    for (int i = 0; i < linear_count(); ++i)
        coefficients[i] = term.at(info().parameters[size_t(i)].key);
    return coefficients;
}

void Effect::set_linear(EffectTerm& term, const Eigen::VectorXd& coefficients) const {
    for (int i = 0; i < linear_count(); ++i)
        term.parameters[info().parameters[size_t(i)].key] = coefficients[i];
}

double Effect::linear_lower(int index) const { return info().parameters[size_t(index)].lower; }

std::vector<EffectTerm> Effect::starts(const Search&) const { return {blank()}; }

Hiding Effect::hide(Draw&) const { return {}; }

EffectTerm Effect::with(std::map<std::string, double> parameters) const {
    EffectTerm out;
    out.name = info().name;
    out.parameters = std::move(parameters);
    return out;
}

EffectTerm Effect::blank() const {
    EffectTerm term;
    term.name = info().name;
    for (const ParameterInfo& p : info().parameters)
        term.parameters[p.key] = p.lower > 0 ? p.lower : p.upper < 0 ? p.upper : 0.0;
    return term;
}

} // namespace servoid
