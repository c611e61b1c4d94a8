#include "compare/regression.hpp"

#include "common/error.hpp"
#include "effects/catalogue.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kBlocksPerCapture = 24;
constexpr double kWorstCondition = 1e6;

const Effect& effect_of(const EffectTerm& term) {
    const Effect* effect = find_effect(term.name);
    if (!effect) throw Error(ExitCode::defect, "no such effect: " + term.name);
    return *effect;
}

std::vector<Coefficient> coefficients_of(const Model& model) {
    std::vector<Coefficient> out = {{-1, 0, model.inertia_fixed, 0}};
    for (size_t i = 0; i < model.effects.size(); ++i) {
        const Effect& effect = effect_of(model.effects[i]);
        for (int k = 0; k < effect.linear_count(); ++k) {
            const ParameterInfo& parameter = effect.info().parameters[size_t(k)];
            out.push_back({int(i), k, model.effects[i].is_fixed(parameter.key), parameter.lower});
        }
    }
    return out;
}

// Columns at the sample rate, in the order of coefficients_of.
Matrix raw_columns(const Model& model, const MotionView& motion) {
    Vector inertia = motion.acceleration;
    for (const EffectTerm& term : model.effects)
        effect_of(term).shape_inertia(term, motion, inertia);
    Matrix out = inertia;
    for (const EffectTerm& term : model.effects) {
        const Matrix more = effect_of(term).columns(term, motion);
        out.conservativeResize(Eigen::NoChange, out.cols() + more.cols());
        out.rightCols(more.cols()) = more;
    }
    return out;
}

Vector values_of(const Model& model) {
    std::vector<double> values = {model.inertia};
    for (const EffectTerm& term : model.effects) {
        const Vector linear = effect_of(term).linear(term);
        values.insert(values.end(), linear.begin(), linear.end());
    }
    return Eigen::Map<Vector>(values.data(), Eigen::Index(values.size()));
}

void set_values(Model& model, const Vector& values) {
    model.inertia = values[0];
    Eigen::Index next = 1;
    for (EffectTerm& term : model.effects) {
        const Effect& effect = effect_of(term);
        effect.set_linear(term, values.segment(next, effect.linear_count()));
        next += effect.linear_count();
    }
}

Matrix pick(const Matrix& columns, const std::vector<int>& which) {
    Matrix out(columns.rows(), Eigen::Index(which.size()));
    for (size_t i = 0; i < which.size(); ++i) out.col(Eigen::Index(i)) = columns.col(which[i]);
    return out;
}

// (XᵀX)⁻¹ (Σ over blocks of g gᵀ) (XᵀX)⁻¹, g = Xᵀr of the block.
Matrix block_covariance(const Matrix& x, const Vector& residual, const std::vector<int>& block) {
    const int blocks = block.empty() ? 0 : block.back() + 1;
    Matrix scores = Matrix::Zero(blocks, x.cols());
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        scores.row(block[size_t(i)]) += residual[i] * x.row(i);
    const Matrix inverse = (x.transpose() * x).ldlt().solve(Matrix::Identity(x.cols(), x.cols()));
    const double spread = double(blocks) / std::max(1.0, double(blocks) - double(x.cols()));
    return inverse * (scores.transpose() * scores) * inverse * spread;
}

double condition_of(const Matrix& x) {
    if (x.cols() < 2) return 1;
    const Matrix scaled = x * x.colwise().norm().cwiseInverse().asDiagonal();
    const Vector singular = Eigen::BDCSVD<Matrix>(scaled).singularValues();
    const double least = singular[singular.size() - 1];
    return least > 0 ? singular[0] / least : INFINITY;
}

void refuse_if_alike(const Regression& regression, const Model& model,
                     const std::vector<int>& free) {
    const Matrix x = pick(regression.columns, free);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        if (!(x.col(i).norm() > 0))
            throw Refusal("nothing in the capture shows " +
                              coefficient_name(model, regression.coefficients[size_t(free[size_t(i)])]),
                          "a move that excites it: both directions, several speeds");
    if (condition_of(x) <= kWorstCondition) return;
    std::string names;
    for (int i : free)
        names += (names.empty() ? "" : ", ") +
                 coefficient_name(model, regression.coefficients[size_t(i)]);
    throw Refusal("the capture cannot tell these apart: " + names,
                  "a move in both directions with several speeds and accelerations");
}

} // namespace

std::string coefficient_name(const Model& model, const Coefficient& coefficient) {
    if (coefficient.term < 0) return "inertia";
    const EffectTerm& term = model.effects[size_t(coefficient.term)];
    return term.name + "." + effect_of(term).info().parameters[size_t(coefficient.index)].key;
}

Regression make_regression(const Model& model, const std::vector<PreparedMotion>& motions) {
    Regression out;
    out.coefficients = coefficients_of(model);
    Eigen::Index rows = 0;
    for (const PreparedMotion& m : motions)
        rows += std::count(m.used.begin(), m.used.end(), true);
    out.columns.resize(rows, Eigen::Index(out.coefficients.size()));
    out.torque.resize(rows);
    out.block.resize(size_t(rows));
    Eigen::Index row = 0;
    int first_block = 0;
    for (const PreparedMotion& m : motions) {
        const Matrix columns = m.band_limit(raw_columns(model, m.motion));
        for (Eigen::Index k = 0; k < m.grid.count; ++k) {
            if (!m.used[size_t(k)]) continue;
            out.columns.row(row) = columns.row(k);
            out.torque[row] = m.torque[k];
            out.block[size_t(row)] = first_block + int(k * kBlocksPerCapture / m.grid.count);
            ++row;
        }
        first_block += kBlocksPerCapture;
    }
    return out;
}

Vector model_torque(const Model& model, const PreparedMotion& motion) {
    return motion.band_limit(raw_columns(model, motion.motion) * values_of(model));
}

FitResult fit(const Model& model, const std::vector<PreparedMotion>& motions) {
    const Regression regression = make_regression(model, motions);
    FitResult out;
    out.model = model;
    out.values = values_of(model);
    out.coefficients = regression.coefficients;
    out.std = Vector::Zero(out.values.size());
    out.covariance = Matrix::Zero(out.values.size(), out.values.size());
    std::vector<int> free;
    for (size_t i = 0; i < out.coefficients.size(); ++i)
        if (!out.coefficients[i].fixed) free.push_back(int(i));
    // Active set: a coefficient that leaves its bound is put on it and the rest is fitted again.
    while (!free.empty()) {
        refuse_if_alike(regression, model, free);
        Vector given = out.values;
        for (int i : free) given[i] = 0;
        const Matrix x = pick(regression.columns, free);
        const Vector target = regression.torque - regression.columns * given;
        const Vector solved = x.colPivHouseholderQr().solve(target);
        int worst = -1;
        double worst_by = 0;
        for (size_t i = 0; i < free.size(); ++i) {
            const double lower = out.coefficients[size_t(free[i])].lower;
            const double by = (lower - solved[Eigen::Index(i)]) * x.col(Eigen::Index(i)).norm();
            if (by > worst_by) worst_by = by, worst = int(i);
        }
        if (worst < 0) {
            const Matrix cov = block_covariance(x, target - x * solved, regression.block);
            for (size_t i = 0; i < free.size(); ++i) {
                out.values[free[i]] = solved[Eigen::Index(i)];
                out.std[free[i]] = std::sqrt(cov(Eigen::Index(i), Eigen::Index(i)));
                for (size_t j = 0; j < free.size(); ++j)
                    out.covariance(free[i], free[j]) = cov(Eigen::Index(i), Eigen::Index(j));
            }
            out.condition = condition_of(x);
            break;
        }
        const int at = free[size_t(worst)];
        out.values[at] = out.coefficients[size_t(at)].lower;
        out.at_bound.push_back(coefficient_name(model, out.coefficients[size_t(at)]));
        free.erase(free.begin() + worst);
    }
    if (!(out.values[0] > 0))
        throw Refusal("the inertia does not come out positive: torque and motion do not belong "
                      "together (a reversed sign, a wrong column or unit)",
                      "torque that is positive where it speeds the axis up");
    set_values(out.model, out.values);
    out.torque_error = (regression.torque - regression.columns * out.values).norm() /
                       regression.torque.norm();
    return out;
}

} // namespace servoid
