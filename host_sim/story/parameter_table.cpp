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

// null beside what was not fitted.
Json correlations(const FitResult& fit) {
    const Eigen::MatrixXd& cov = fit.parameter_covariance;
    Json out = Json::array();
    for (Eigen::Index i = 0; i < cov.rows(); ++i) {
        Json row = Json::array();
        for (Eigen::Index j = 0; j < cov.cols(); ++j)
            row.push_back(number(cov(i, j) / std::sqrt(cov(i, i) * cov(j, j))));
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
    out["correlation"] = correlations(fit);
    return out;
}

} // namespace servoid
