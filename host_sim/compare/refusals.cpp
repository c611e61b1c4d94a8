#include "compare/refusals.hpp"

#include "common/error.hpp"
#include "common/text.hpp"
#include "compare/one_way.hpp"
#include "compare/regression.hpp"
#include "compare/solve.hpp"
#include "effects/catalogue.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kSeparate = 1e-6; // of a slope: what no other parameter can take up

// Of a vector from the plane that columns span.
double distance(const Vector& vector, const Matrix& columns) {
    return (vector - columns * shortest_least_squares(columns, vector)).norm();
}

bool is_free(const Model& model, const std::string& prefix) {
    return std::any_of(model.effects.begin(), model.effects.end(), [&](const EffectTerm& term) {
        return term.name.starts_with(prefix) && term.fixed.empty();
    });
}

} // namespace

void refuse_one_way(const Model& model, const std::vector<PreparedMotion>& motions) {
    if (!is_free(model, "coulomb") || !is_free(model, "constant_torque")) return;
    if (!moves_one_way(motions)) return;
    throw Refusal("the axis moves one way only: Coulomb friction and a constant torque cannot be "
                  "told apart",
                  "the same move in both directions, or fix one of them in the model");
}

void refuse_if_undetermined(const FittedShape& shape, const Matrix& slopes, Eigen::Index column) {
    const EffectTerm& term = shape.model.effects[shape.term];
    if (!find_effect(term.name)->info().written) return;
    const std::string name = term_name(shape.model, shape.term) + "." + shape.key;
    const Vector slope = slopes.col(column);
    if (!slope.allFinite())
        throw Refusal(
            "the law of " + term.name + " has no finite value beside " + shape.key + " = " +
                format_number(term.at(shape.key)),
            "nothing else, but write abs(theta)^n*sign(theta) instead of theta^n, or fix " + name);
    Matrix others = slopes;
    others.col(column).setZero();
    if (others.allFinite() && !(distance(slope, others) > kSeparate * slope.norm()))
        throw Refusal("the capture cannot tell " + name + " from the other parameters",
                      "a move that shows it, or fix it in the model");
}

} // namespace servoid
