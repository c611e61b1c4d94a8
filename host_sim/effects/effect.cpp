#include "effects/effect.hpp"

#include "effects/hiding.hpp"

#include <cmath>
#include <limits>

namespace servoid {

Eigen::VectorXd Effect::linear(const EffectTerm& term) const {
    const std::vector<ParameterInfo> known = parameters(term);
    Eigen::VectorXd coefficients(linear_count(term));
    for (int i = 0; i < linear_count(term); ++i)
        coefficients[i] = term.at(known[size_t(i)].key);
    return coefficients;
}

void Effect::set_linear(EffectTerm& term, const Eigen::VectorXd& coefficients) const {
    const std::vector<ParameterInfo> known = parameters(term);
    for (int i = 0; i < linear_count(term); ++i)
        term.parameters[known[size_t(i)].key] = coefficients[i];
}

double Effect::linear_lower(int index) const { return info().parameters[size_t(index)].lower; }

bool Effect::linear_fixed(const EffectTerm& term, int index) const {
    return term.is_fixed(parameters(term)[size_t(index)].key);
}

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
