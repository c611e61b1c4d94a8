// The torque view: the torque that a model needs for the measured motion, as columns times
// parameters, and their least-squares fit.
#pragma once

#include "compare/motion.hpp"
#include "model/model.hpp"

#include <string>
#include <vector>

namespace servoid {

// One coefficient of the regression: the inertia (term −1) or a linear coefficient of an effect.
struct Coefficient {
    int term = -1;
    int index = 0;
    bool fixed = false;
    double lower = 0;
};

// What a model needs for one or several captures; rows are the used points of all of them.
struct Regression {
    Eigen::MatrixXd columns; // rows × coefficients
    Eigen::VectorXd torque;  // rows
    std::vector<Coefficient> coefficients;
    std::vector<int> block; // rows: points that belong together, for errors that are correlated
};

Regression make_regression(const Model& model, const std::vector<PreparedMotion>& motions);

// The model's own torque on every point of the grid of one capture (used or not).
Eigen::VectorXd model_torque(const Model& model, const PreparedMotion& motion);

struct FitResult {
    Model model;                       // with the fitted values
    Eigen::VectorXd values, std;       // of all coefficients, in the order of the regression
    Eigen::MatrixXd covariance;
    std::vector<Coefficient> coefficients;
    std::vector<std::string> at_bound; // names of parameters that physics stopped
    double condition = 0;              // of the scaled free columns
    double torque_error = 0;           // ‖T − T̂‖/‖T‖
};

// Least squares of all coefficients that are not fixed, with dissipation kept ≥ 0. The standard
// deviations are block-robust (scores summed over blocks of the record), so they hold for residuals
// that are correlated in time. Throws Refusal where the columns cannot be told apart.
FitResult fit(const Model& model, const std::vector<PreparedMotion>& motions);

// "inertia", "viscous.coefficient".
std::string coefficient_name(const Model& model, const Coefficient& coefficient);

} // namespace servoid
