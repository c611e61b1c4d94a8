#include "compare/start_search.hpp"

#include "compare/regression.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>

namespace servoid {

namespace {

constexpr double kMultiples[] = {3, 1. / 3, 10, 0.1};
constexpr double kBetter = 0.999;  // of the error: else the start value stands
constexpr double kOtherSign = 0.9; // the same, for a sign that the user did not write

struct Best {
    double value = 0, error = 0;
};

void try_value(Best& best, double value, double needed, double& place, const Model& model,
               Assembler& assembler) {
    place = value;
    const double error = linear_error(model, assembler);
    if (error < needed * best.error) best = {value, error};
}

void choose_start(Model& model, size_t term, const std::string& key, Assembler& assembler) {
    double& place = model.effects[term].parameters[key];
    const double start = place;
    Best best{start, linear_error(model, assembler)};
    for (double multiple : kMultiples)
        try_value(best, multiple * start, kBetter, place, model, assembler);
    Best mirrored = best;
    try_value(mirrored, -start, kOtherSign, place, model, assembler);
    for (double multiple : kMultiples)
        try_value(mirrored, -multiple * start, kOtherSign, place, model, assembler);
    place = mirrored.value;
}

bool feeds_back(const EffectTerm& term) {
    const Effect& effect = *find_effect(term.name);
    return effect.info().written && effect.uses_torque(term);
}

} // namespace

bool feeds_back(const Model& model) {
    return std::any_of(model.effects.begin(), model.effects.end(),
                       [](const EffectTerm& term) { return feeds_back(term); });
}

Model without_start_torque(Model model) {
    for (EffectTerm& term : model.effects) {
        if (!feeds_back(term)) continue;
        const Effect& effect = *find_effect(term.name);
        Eigen::VectorXd linear = effect.linear(term);
        for (Eigen::Index i = 0; i < linear.size(); ++i)
            if (!effect.linear_fixed(term, int(i))) linear[i] = 0;
        effect.set_linear(term, linear);
    }
    return model;
}

Model with_best_starts(Model model, Assembler& assembler) {
    for (size_t i = 0; i < model.effects.size(); ++i) {
        const EffectTerm& term = model.effects[i];
        const Effect& effect = *find_effect(term.name);
        if (!effect.info().written) continue;
        const std::vector<std::string> keys = effect.shape_keys(term);
        for (size_t pass = 0; pass < (keys.size() > 1 ? 2 : 1); ++pass)
            for (const std::string& key : keys)
                if (!term.is_fixed(key) && term.at(key) != 0)
                    choose_start(model, i, key, assembler);
    }
    return model;
}

} // namespace servoid
