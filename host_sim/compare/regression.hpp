// The fit of a model in the torque view.
//
// T_delivered(q) = columns(q)·c + residual: linear in the coefficients c (inertia, friction, ...),
// not in the shape parameters q (an order, a delay, a gap). For each q the best c is known
// (variable projection, Golub and Pereyra 1973), so only q is searched, by damped Gauss-Newton
// steps.
#pragma once

#include "compare/assembly.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace servoid {

// One parameter of a fitted model under its full name: "inertia", "viscous.coefficient"; the second
// cogging of a model is "cogging#2.amplitude".
struct FittedParameter {
    std::string name;
    Quantity quantity = Quantity::ratio;
    Estimate estimate;
    bool fixed = false;
    bool at_bound = false; // physics stopped it: something else is missing, or it is not there
};

struct FitResult {
    Model model; // with the fitted values
    std::vector<FittedParameter> parameters;
    std::vector<Coefficient> coefficients; // the linear part, in the order of the columns
    Eigen::VectorXd values, std;           // of the coefficients
    Eigen::MatrixXd covariance;            // of the coefficients
    Eigen::MatrixXd parameter_covariance;  // of `parameters`, to first order; empty: not asked for
    std::vector<std::string> at_bound;     // names of parameters on a bound
    double condition = 0;                  // of the scaled free columns
    double torque_error = 0;               // ‖T − T̂‖/‖T‖
    double noise_passed = 1;               // of the asked torque's noise, in amplitude
    bool converged = false;                // false: the bound on iterations was met
    Eigen::VectorXd residual, torque;      // on the used points
    std::vector<int> block;                // of the used points, for correlated errors
    Eigen::VectorXd artifact;              // what was taken out of the torque beforehand
    double doubt = 0; // of the torque: an artifact that may be there as well, and is not confirmed
    Homing homing;    // where the captures' position zeros lie
    int free_parameters = 0;
    size_t believed_terms = SIZE_MAX; // as in FitOptions
    // What fits are compared by: what takes noise from the torque has no merit by that.
    double score() const { return torque_error / noise_passed; }
};

struct FitOptions {
    int most_iterations = 12; // of the shape parameters
    bool uncertainty = true;  // else the std are left at 0
    size_t frozen_terms = 0;  // effects at the front of the model whose shapes stay as they are
    size_t believed_terms = SIZE_MAX; // effects at the front whose shapes stay near their values
    // Shapes of laws that the user wrote are no beliefs: multiples of them are tried, and they go
    // where they like.
    bool start_values = true;
};

// Of a fit that goes on from another: the same beliefs, the shapes from where they are.
FitOptions going_on_from(const FitResult& fitted);

// Least squares of everything that is not fixed, with dissipation kept ≥ 0. Standard deviations are
// block-robust (scores summed over blocks of the record), so they hold for residuals that are
// correlated in time. Offsets of the assembler's homing that are not 0 are fitted too, and left in
// it. Throws Refusal where the parameters cannot be told apart.
FitResult fit(const Model& model, const std::vector<PreparedMotion>& motions);
FitResult fit(const Model& model, Assembler& assembler, const FitOptions& options = {});

// How the model's torque moves with everything that was fitted, to first order: the free columns,
// then one column per shape parameter, then one per offset of the homing (rows: used points).
Eigen::MatrixXd joint_slopes(const FitResult& fitted, Assembler& assembler);

// ‖T − T̂‖/‖T‖ with the shapes as they are and the coefficients solved for; infinite where they
// cannot be told apart.
double linear_error(const Model& model, Assembler& assembler);

// The model's own torque on every point of the grid of one capture (used or not), and the torque
// that reaches its motor.
Eigen::VectorXd model_torque(const Model& model, const PreparedMotion& motion);
Eigen::VectorXd delivered_torque(const Model& model, const PreparedMotion& motion);

// "viscous", or "cogging#2" for the second of that name.
std::string term_name(const Model& model, size_t term);

// "viscous.coefficient" of a linear coefficient ("inertia" for the inertia).
std::string coefficient_name(const Model& model, const Coefficient& coefficient);

} // namespace servoid
