#include "compare/regression.hpp"

#include "common/error.hpp"
#include "compare/linear_fit.hpp"
#include "compare/one_way.hpp"
#include "compare/refusals.hpp"
#include "compare/solve.hpp"
#include "compare/start_search.hpp"
#include "compare/uncertainty.hpp"
#include "effects/catalogue.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kMostContexts = 12;        // of a law that depends on the torque
constexpr double kLeastDelivered = 0.03; // of the asked torque, in norm
constexpr double kTakesWork = 0.02;      // of the power's size: the torque drives the axis

// One evaluation: the model's shapes as they are, the coefficients solved for.
struct State {
    Model model;
    Assembly assembly;
    LinearFit linear;
    Vector residual;
    double error = 0;        // ‖r‖/‖T‖
    double noise_passed = 1; // of the asked torque's, in amplitude
    Homing homing;
    double score() const { return error / noise_passed; }
};

State evaluate(const Model& model, Assembler& assembler) {
    State s{model, assembler.assemble(model), {}, {}, 0, 1, assembler.homing()};
    std::vector<bool> fixed, vanished;
    std::vector<double> lower;
    for (size_t i = 0; i < s.assembly.coefficients.size(); ++i) {
        const Coefficient& c = s.assembly.coefficients[i];
        const bool zero = !(s.assembly.columns.col(Eigen::Index(i)).norm() > 0);
        vanished.push_back(c.may_vanish && zero);
        fixed.push_back(c.fixed || vanished.back()), lower.push_back(c.lower);
    }
    s.linear =
        solve({s.assembly.columns, s.assembly.torque, coefficient_values(model), fixed, lower});
    s.residual = s.assembly.torque - s.assembly.columns * s.linear.values;
    s.error = s.residual.norm() / std::max(1e-300, s.assembly.torque.norm());
    // A limit or a gain that lets no torque through explains everything and nothing.
    const bool delivers = s.assembly.torque.norm() > kLeastDelivered * assembler.asked_norm();
    s.noise_passed = noise_passed(model, assembler.motions());
    if (!s.linear.solved || !delivers) {
        s.error = INFINITY;
        return s;
    }
    Vector told = s.linear.values;
    for (size_t i = 0; i < vanished.size(); ++i)
        if (vanished[i]) told[Eigen::Index(i)] = NAN;
    set_coefficient_values(s.model, told);
    return s;
}

// How the residual moves with each shape, the coefficients held.
Matrix shape_slopes(const State& s, const std::vector<Shape>& shapes, Assembler& assembler) {
    Matrix out(s.residual.size(), Eigen::Index(shapes.size()));
    for (size_t i = 0; i < shapes.size(); ++i) {
        Model moved = s.model;
        double& value = moved.effects[shapes[i].term].parameters[shapes[i].key];
        const double step = step_of(shapes[i], value);
        value += step;
        const Assembly a = assembler.assemble(moved);
        // As a share of the torque and of its noise, which a limit makes smaller: see `objective`.
        const double scale = s.assembly.torque.norm() / std::max(1e-300, a.torque.norm()) *
                             s.noise_passed / noise_passed(moved, assembler.motions());
        // The coefficients of the moved term may be defined by its shapes: taken from the model.
        out.col(Eigen::Index(i)) =
            (scale * (a.torque - a.columns * coefficient_values(moved)) - s.residual) / step;
    }
    return out;
}

// The same of the offsets that are not 0.
Matrix homing_slopes(const State& s, const Assembler& assembler) {
    const std::vector<size_t> moved = s.homing.all_moved();
    const std::vector<PositionWave> waves = waves_of(s.model);
    Matrix out = Matrix::Zero(s.residual.size(), Eigen::Index(moved.size()));
    for (size_t i = 0; i < moved.size(); ++i) {
        const Rows rows = assembler.rows_of(moved[i]);
        out.col(Eigen::Index(i)).segment(rows.first, rows.count) =
            -offset_slope(s.assembly.columns.middleRows(rows.first, rows.count), waves,
                          coefficient_values(s.model));
    }
    return out;
}

// No step moves an offset further than half a radian of the fastest wave.
Homing moved_by(const State& s, const Vector& by) {
    const double most = 0.5 / std::max(1e-300, fastest_wave(waves_of(s.model)));
    Homing out = s.homing;
    Eigen::Index next = 0;
    for (size_t i : s.homing.all_moved())
        out.offset[i].value += std::clamp(by[next++], -most, most);
    return out;
}

Model moved_by(const State& s, const std::vector<Shape>& shapes, const Vector& by) {
    Model out = s.model;
    for (size_t i = 0; i < shapes.size(); ++i) {
        double& value = out.effects[shapes[i].term].parameters[shapes[i].key];
        // No step takes a shape further than to three times or a third of what it was; a place that
        // may lie on either side of zero begins there.
        const double was = value;
        value = std::clamp(value + by[Eigen::Index(i)], shapes[i].lower, shapes[i].upper);
        if (was != 0)
            value = std::clamp(value, std::min(was / 3, was * 3), std::max(was / 3, was * 3));
    }
    return out;
}

// A shape that the user believes in is known to some ten per cent. Where the motion does not show
// it, it would else run away and take up what something else has caused; where it does, the belief
// weighs nothing. Residuals are correlated: as if one in ten samples were independent.
void stay_near_beliefs(std::vector<Shape>& shapes, const State& s, const FitOptions& options) {
    constexpr double kBelief = 0.1, kCorrelated = 10;
    for (Shape& shape : shapes) {
        const EffectTerm& term = s.model.effects[shape.term];
        const double value = term.at(shape.key);
        if (shape.term >= options.believed_terms || !(value > 0)) continue;
        if (options.start_values && find_effect(term.name)->info().written) continue;
        shape.lower = std::max(shape.lower, value / 1.5);
        shape.upper = std::min(shape.upper, value * 1.5);
        shape.belief = value;
        shape.weight = kCorrelated * s.residual.squaredNorm() / double(s.residual.size()) /
                       std::pow(kBelief * value, 2);
    }
}

// What the descent makes small: the power of the residual and the distance from what is believed.
// The residual counts as a share of the delivered torque and of the noise that comes with it: a
// limit that is too low, with an inertia that is too small by as much, would else leave less of
// everything, and a lag less of the noise (Box and Cox, JRSS B 26, 1964: a transformed response
// needs its Jacobian).
double objective(const State& s, const std::vector<Shape>& shapes, double asked_norm) {
    if (!std::isfinite(s.error)) return INFINITY;
    double sum = std::pow(s.score() * asked_norm, 2);
    for (const Shape& shape : shapes)
        sum += shape.weight * std::pow(s.model.effects[shape.term].at(shape.key) - shape.belief, 2);
    return sum;
}

// Levenberg-Marquardt over the shapes on the projected residual (Kaufman's simplification). Returns
// whether it came to rest.
bool descend(State& s, Assembler& assembler, const FitOptions& options) {
    std::vector<Shape> shapes = shapes_of(s.model, options.frozen_terms);
    stay_near_beliefs(shapes, s, options);
    const auto count = Eigen::Index(shapes.size());
    const auto offsets = Eigen::Index(s.homing.all_moved().size());
    if (count + offsets == 0) return true;
    const double asked = assembler.asked_norm();
    double damping = 1e-3;
    for (int iteration = 0; iteration < options.most_iterations; ++iteration) {
        const Matrix x = pick(s.assembly.columns, s.linear.free);
        Matrix slopes(s.residual.size(), count + offsets);
        slopes << shape_slopes(s, shapes, assembler), homing_slopes(s, assembler);
        for (Eigen::Index i = 0; i < slopes.cols(); ++i) // a law without a value beside this one
            if (!slopes.col(i).allFinite()) slopes.col(i).setZero();
        if (x.cols() > 0)
            slopes -= x * solve_symmetric(x.transpose() * x, Matrix(x.transpose() * slopes));
        const Vector scale = slopes.colwise().norm().cwiseMax(1e-300).cwiseInverse();
        slopes = slopes * scale.asDiagonal();
        Matrix normal = slopes.transpose() * slopes;
        Vector gradient = slopes.transpose() * s.residual;
        for (Eigen::Index i = 0; i < count; ++i) {
            const Shape& shape = shapes[size_t(i)];
            const double value = s.model.effects[shape.term].at(shape.key);
            normal(i, i) += shape.weight * scale[i] * scale[i];
            gradient[i] += shape.weight * scale[i] * (value - shape.belief);
        }
        bool better = false;
        const double before = objective(s, shapes, asked);
        for (int attempt = 0; attempt < 5 && !better; ++attempt) {
            Matrix damped = normal;
            damped.diagonal().array() += damping;
            const Vector by = -(scale.asDiagonal() * solve_symmetric(damped, gradient));
            assembler.set_homing(moved_by(s, by.tail(offsets)));
            State next = evaluate(moved_by(s, shapes, by), assembler);
            better = objective(next, shapes, asked) < before;
            if (better)
                s = std::move(next), damping = std::max(1e-9, damping / 8);
            else
                damping *= 10;
        }
        assembler.set_homing(s.homing);
        if (!better || before - objective(s, shapes, asked) < 2e-6 * before) return true;
    }
    return false;
}

void refuse_if_alike(const State& s) {
    if (s.linear.solved) return;
    std::string names;
    for (int i : s.linear.free) {
        const std::string name = coefficient_name(s.model, s.assembly.coefficients[size_t(i)]);
        if (!(s.assembly.columns.col(i).norm() > 0))
            throw Refusal("nothing in the capture shows " + name,
                          "a move that excites it: both directions, several speeds");
        names += (names.empty() ? "" : ", ") + name;
    }
    throw Refusal("the capture cannot tell these apart: " + names,
                  "a move in both directions with several speeds and accelerations");
}

// How the residual moves with everything that is fitted.
Joint joint_of(const State& s, Assembler& assembler) {
    Joint out{{}, s.linear.free, shapes_of(s.model), s.homing.all_moved()};
    const Matrix x = pick(s.assembly.columns, out.free);
    out.slopes.resize(x.rows(), x.cols() + Eigen::Index(out.shapes.size() + out.moved.size()));
    out.slopes << x, -shape_slopes(s, out.shapes, assembler), -homing_slopes(s, assembler);
    return out;
}

bool settled(const Vector& before, const Vector& after) {
    return ((after - before).array().abs() <= 1e-6 * after.array().abs()).all();
}

} // namespace

std::string term_name(const Model& model, size_t term) {
    int number = 1;
    for (size_t i = 0; i < term; ++i)
        number += model.effects[i].name == model.effects[term].name;
    const std::string& name = model.effects[term].name;
    return number == 1 ? name : name + "#" + std::to_string(number);
}

std::string coefficient_name(const Model& model, const Coefficient& coefficient) {
    if (coefficient.term < 0) return "inertia";
    const EffectTerm& term = model.effects[size_t(coefficient.term)];
    return term_name(model, size_t(coefficient.term)) + "." +
           find_effect(term.name)->parameters(term)[size_t(coefficient.index)].key;
}

Matrix joint_slopes(const FitResult& fitted, Assembler& assembler) {
    assembler.set_artifact(fitted.artifact);
    assembler.set_homing(fitted.homing);
    assembler.set_context(fitted.model);
    const State s = evaluate(fitted.model, assembler);
    return joint_of(s, assembler).slopes;
}

double linear_error(const Model& model, Assembler& assembler) {
    return evaluate(model, assembler).error;
}

namespace {

// The torque counted the other way round explains the motion: not a missing effect.
void refuse_if_reversed(const State& s, double believed, double error_held,
                        const std::vector<PreparedMotion>& motions) {
    const double work = work_share(motions);
    if (work > kTakesWork) return;
    std::vector<bool> fixed;
    std::vector<double> lower;
    for (const Coefficient& c : s.assembly.coefficients)
        fixed.push_back(c.fixed), lower.push_back(c.lower);
    const Vector reversed = -s.assembly.torque;
    const LinearFit other =
        solve({s.assembly.columns, reversed, coefficient_values(s.model), fixed, lower});
    const double error =
        (reversed - s.assembly.columns * other.values).norm() / std::max(1e-300, reversed.norm());
    // A strong spring in a slow move turns the inertia over too, and by far; not the work, where
    // there is friction to take it.
    const double ratio = other.values[0] / believed;
    const bool believable = work < -kTakesWork || (ratio > 0.2 && ratio < 5);
    if (!other.solved || !believable || error > 0.7 * error_held) return;
    throw Refusal("the inertia does not come out positive: torque looks reversed",
                  "torque that is positive where it speeds the axis up");
}

// Something strong that is missing may turn the inertia's sign: it then stays as it is believed.
FitResult with_inertia_held(const Model& model, const State& s, Assembler& assembler,
                            const FitOptions& options) {
    Model held = model;
    held.inertia_fixed = true;
    if (model.inertia_fixed || !(model.inertia > 0))
        throw Refusal("the inertia does not come out positive: torque and motion do not belong "
                      "together (a wrong column or unit)",
                      "torque that is positive where it speeds the axis up");
    FitResult out = fit(held, assembler, options);
    refuse_if_reversed(s, model.inertia, out.torque_error, assembler.motions());
    out.model.inertia_fixed = false;
    return out;
}

} // namespace

FitResult fit(const Model& model, Assembler& assembler, const FitOptions& options) {
    refuse_one_way(model, assembler.motions());
    // Laws that change others (a drift of friction), or that depend on the torque, see the model as
    // it was: once more with what came out, and until it settles where the user's laws do.
    const int most = feeds_back(model) ? kMostContexts : 2;
    if (waves_of(model).empty()) assembler.set_homing({});
    State s;
    s.model = options.start_values ? without_start_torque(model) : model;
    bool converged = true;
    Vector before;
    for (int pass = 0; pass < most; ++pass) {
        assembler.set_context(s.model);
        const bool search = pass == 0 && options.start_values;
        s = evaluate(search ? with_best_starts(s.model, assembler) : s.model, assembler);
        refuse_if_alike(s);
        converged = descend(s, assembler, options) && converged;
        if (pass > 0 && settled(before, s.linear.values)) break;
        before = s.linear.values;
    }
    if (!(s.linear.values[0] > 0)) return with_inertia_held(model, s, assembler, options);
    FitResult out;
    out.model = s.model;
    out.coefficients = s.assembly.coefficients;
    out.values = s.linear.values;
    out.torque_error = s.error, out.noise_passed = s.noise_passed;
    out.converged = converged;
    out.residual = s.residual, out.torque = s.assembly.torque, out.block = s.assembly.block;
    out.artifact = assembler.artifact(), out.homing = s.homing;
    out.believed_terms = options.believed_terms;
    Joint joint{{}, s.linear.free, shapes_of(s.model), s.homing.all_moved()};
    if (options.uncertainty) {
        joint = joint_of(s, assembler);
        out.condition = condition_of(pick(s.assembly.columns, s.linear.free));
    }
    out.free_parameters = int(joint.free.size() + joint.shapes.size() + joint.moved.size());
    add_uncertainty(out, joint);
    return out;
}

FitOptions going_on_from(const FitResult& fitted) {
    FitOptions out;
    out.believed_terms = fitted.believed_terms;
    out.start_values = false;
    return out;
}

FitResult fit(const Model& model, const std::vector<PreparedMotion>& motions) {
    Assembler assembler(motions);
    return fit(model, assembler);
}

Vector model_torque(const Model& model, const PreparedMotion& motion) {
    return motion.band_limit(Matrix(in_context(model, motion.motion).torque));
}

Vector delivered_torque(const Model& model, const PreparedMotion& motion) {
    return motion.band_limit(delivered_by(model, motion.asked));
}

} // namespace servoid
