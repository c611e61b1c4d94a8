#include "model/model.hpp"

#include <algorithm>

namespace servoid {

bool EffectTerm::is_fixed(const std::string& key) const {
    return std::find(fixed.begin(), fixed.end(), key) != fixed.end();
}

double EffectTerm::at(const std::string& key) const { return parameters.at(key); }

const EffectTerm* Model::find(const std::string& effect) const {
    for (const EffectTerm& term : effects)
        if (term.name == effect) return &term;
    return nullptr;
}

} // namespace servoid
