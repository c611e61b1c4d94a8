#include "story/parameter_table.hpp"

#include "effects/catalogue.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace servoid {

namespace {

struct Place {
    double value = NAN, lower = NAN, upper = NAN;
};

// Every parameter of a model by its full name.
std::map<std::string, Place> places_of(const Model& model) {
    std::map<std::string, Place> out = {{"inertia", {model.inertia, 0, INFINITY}}};
    for (size_t i = 0; i < model.effects.size(); ++i) {
        const EffectTerm& term = model.effects[i];
        for (const ParameterInfo& p : find_effect(term.name)->parameters(term))
            out[term_name(model, i) + "." + p.key] = {term.at(p.key), p.lower, p.upper};
    }
    return out;
}

// The coefficient that is this parameter and nothing else; −1 for shapes and for the amplitude and
// phase of a wave, which are made of two.
std::map<std::string, Eigen::Index> coefficients_by_name(const FitResult& fit,
                                                         const std::map<std::string, Place>& is) {
    std::map<std::string, Eigen::Index> out;
    for (size_t i = 0; i < fit.coefficients.size(); ++i) {
        const std::string name = coefficient_name(fit.model, fit.coefficients[i]);
        const auto place = is.find(name);
        if (place != is.end() && fit.values[Eigen::Index(i)] == place->second.value)
            out[name] = Eigen::Index(i);
    }
    return out;
}

Json correlations(const FitResult& fit, const std::map<std::string, Place>& is) {
    const auto at = coefficients_by_name(fit, is);
    Json out = Json::array();
    for (const FittedParameter& a : fit.parameters) {
        Json row = Json::array();
        for (const FittedParameter& b : fit.parameters) {
            const auto i = at.find(a.name), j = at.find(b.name);
            const bool known = i != at.end() && j != at.end();
            row.push_back(known ? number(fit.covariance(i->second, j->second) /
                                         std::sqrt(fit.covariance(i->second, i->second) *
                                                   fit.covariance(j->second, j->second)))
                                : Json(nullptr));
        }
        out.push_back(row);
    }
    return out;
}

} // namespace

Json parameter_table(const FitResult& fit, const Model& given, bool ampere) {
    const auto is = places_of(fit.model), was = places_of(given);
    Json out = Json::object();
    for (const char* column :
         {"name", "unit", "value", "std", "believed", "fixed", "at_bound", "lower", "upper"})
        out[column] = Json::array();
    for (const FittedParameter& p : fit.parameters) {
        const auto place = is.find(p.name), before = was.find(p.name);
        out["name"].push_back(p.name);
        out["unit"].push_back(unit_of(p.quantity, fit.model.motion, ampere));
        out["value"].push_back(number(p.estimate.value));
        out["std"].push_back(p.fixed ? Json(nullptr) : number(p.estimate.std));
        out["believed"].push_back(before == was.end() ? Json(nullptr)
                                                      : number(before->second.value));
        out["fixed"].push_back(p.fixed);
        out["at_bound"].push_back(p.at_bound);
        out["lower"].push_back(place == is.end() ? Json(nullptr) : number(place->second.lower));
        out["upper"].push_back(place == is.end() ? Json(nullptr) : number(place->second.upper));
    }
    out["correlation"] = correlations(fit, is);
    return out;
}

} // namespace servoid
