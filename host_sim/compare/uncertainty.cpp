#include "compare/uncertainty.hpp"

#include "compare/linear_fit.hpp"
#include "compare/refusals.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

std::vector<Shape> shapes_of(const Model& model, size_t first) {
    std::vector<Shape> out;
    for (size_t i = first; i < model.effects.size(); ++i) {
        const EffectTerm& term = model.effects[i];
        const Effect& effect = *find_effect(term.name);
        for (const std::string& key : effect.shape_keys(term)) {
            if (term.is_fixed(key)) continue;
            for (const ParameterInfo& p : effect.parameters(term))
                if (p.key == key) out.push_back({i, key, p.lower, p.upper, effect.slope_step()});
        }
    }
    return out;
}

double step_of(const Shape& shape, double value) {
    // Near zero nothing says how large a shape is that may lie on either side.
    const double least = shape.lower < 0 ? 1e-6 : 1e-12;
    const double step = shape.step * std::max(std::abs(value), least);
    return value + step <= shape.upper ? step : -step;
}

namespace {

// How the parameters of a term, in the order of its effect, move with the joint vector: amplitude
// and phase with two coefficients, for instance. By differences.
Matrix term_slopes(const FitResult& fitted, size_t term, const Joint& joint) {
    const EffectTerm& base = fitted.model.effects[term];
    const Effect& effect = *find_effect(base.name);
    const std::vector<ParameterInfo> parameters = effect.parameters(base);
    Matrix slopes = Matrix::Zero(Eigen::Index(parameters.size()), joint.slopes.cols());
    const auto put = [&](Eigen::Index at, const EffectTerm& moved, double step) {
        Eigen::Index row = 0;
        for (const ParameterInfo& p : parameters)
            slopes(row++, at) = (moved.at(p.key) - base.at(p.key)) / step;
    };
    const Vector linear = effect.linear(base);
    for (size_t i = 0; i < joint.free.size(); ++i) {
        const Coefficient& c = fitted.coefficients[size_t(joint.free[i])];
        if (c.term != int(term)) continue;
        Vector moved = linear;
        const double step = 1e-6 * std::max(linear.cwiseAbs().maxCoeff(), 1e-12);
        moved[c.index] += step;
        EffectTerm other = base;
        effect.set_linear(other, moved);
        put(Eigen::Index(i), other, step);
    }
    for (size_t i = 0; i < joint.shapes.size(); ++i) {
        if (joint.shapes[i].term != term) continue;
        EffectTerm other = base;
        const double step = step_of(joint.shapes[i], base.at(joint.shapes[i].key));
        other.parameters[joint.shapes[i].key] += step;
        put(Eigen::Index(joint.free.size() + i), other, step);
    }
    return slopes;
}

// The same for all parameters: the inertia, then those of each term.
Matrix parameter_slopes(const FitResult& fitted, const Joint& joint) {
    Matrix out = Matrix::Zero(1, joint.slopes.cols());
    for (size_t i = 0; i < joint.free.size(); ++i)
        if (fitted.coefficients[size_t(joint.free[i])].term < 0) out(0, Eigen::Index(i)) = 1;
    for (size_t t = 0; t < fitted.model.effects.size(); ++t) {
        const Matrix term = term_slopes(fitted, t, joint);
        out.conservativeResize(out.rows() + term.rows(), Eigen::NoChange);
        out.bottomRows(term.rows()) = term;
    }
    return out;
}

bool on_bound(const FitResult& out, int term, int index) {
    for (size_t i = 0; i < out.coefficients.size(); ++i) {
        const Coefficient& c = out.coefficients[i];
        if (c.term == term && c.index == index && !c.fixed &&
            out.values[Eigen::Index(i)] <= c.lower)
            return true;
    }
    return false;
}

void list_parameters(FitResult& out) {
    const Matrix& cov = out.parameter_covariance;
    const auto std_of = [&](size_t place) {
        const auto i = Eigen::Index(place);
        return cov.size() ? std::sqrt(std::max(0.0, cov(i, i))) : 0.0;
    };
    out.parameters.clear(), out.at_bound.clear();
    out.parameters.push_back({"inertia",
                              Quantity::inertia,
                              {out.values[0], out.std[0]},
                              out.model.inertia_fixed,
                              false});
    for (size_t t = 0; t < out.model.effects.size(); ++t) {
        const EffectTerm& term = out.model.effects[t];
        const Effect& effect = *find_effect(term.name);
        int index = 0;
        for (const ParameterInfo& p : effect.parameters(term)) {
            FittedParameter one{term_name(out.model, t) + "." + p.key,
                                p.quantity,
                                {term.at(p.key), std_of(out.parameters.size())},
                                term.is_fixed(p.key),
                                index < effect.linear_count(term) && on_bound(out, int(t), index)};
            if (one.at_bound) out.at_bound.push_back(one.name);
            out.parameters.push_back(one);
            ++index;
        }
    }
}

} // namespace

void add_uncertainty(FitResult& out, const Joint& joint) {
    out.std = Vector::Zero(out.values.size());
    out.covariance = Matrix::Zero(out.values.size(), out.values.size());
    out.parameter_covariance.resize(0, 0);
    if (joint.slopes.cols() > 0) {
        const auto columns = Eigen::Index(joint.free.size());
        for (size_t i = 0; i < joint.shapes.size(); ++i)
            refuse_if_undetermined({out.model, joint.shapes[i].term, joint.shapes[i].key},
                                   joint.slopes, columns + Eigen::Index(i));
        const Matrix cov = block_covariance(joint.slopes, out.residual, out.block);
        for (size_t i = 0; i < joint.free.size(); ++i) {
            out.std[joint.free[i]] = std::sqrt(cov(Eigen::Index(i), Eigen::Index(i)));
            for (size_t j = 0; j < joint.free.size(); ++j)
                out.covariance(joint.free[i], joint.free[j]) =
                    cov(Eigen::Index(i), Eigen::Index(j));
        }
        const Matrix slopes = parameter_slopes(out, joint);
        out.parameter_covariance = slopes * cov * slopes.transpose();
        const auto offsets = columns + Eigen::Index(joint.shapes.size());
        for (size_t i = 0; i < joint.moved.size(); ++i) {
            const Eigen::Index at = offsets + Eigen::Index(i);
            out.homing.offset[joint.moved[i]].std = std::sqrt(std::max(0.0, cov(at, at)));
        }
    }
    list_parameters(out);
}

} // namespace servoid
