// How well a fit knows what it fitted.
#pragma once

#include "compare/regression.hpp"

#include <string>
#include <vector>

namespace servoid {

// A shape parameter that the fit may move.
struct Shape {
    size_t term;
    std::string key;
    double lower, upper;
    double step = 1e-4;            // relative, for slopes
    double belief = 0, weight = 0; // what pulls it back: weight·(value − belief)²
};

// Those of the effects from `first` on that are not fixed.
std::vector<Shape> shapes_of(const Model& model, size_t first = 0);
// The difference step of a shape: relative, towards the side that its bounds leave.
double step_of(const Shape& shape, double value);

// All numbers that were fitted, as one vector: free coefficients, then shapes, then offsets.
struct Joint {
    Eigen::MatrixXd slopes; // of the residual's negative: columns, shapes, offsets
    std::vector<int> free;
    std::vector<Shape> shapes;
    std::vector<size_t> moved; // captures whose offset was fitted
};

// Fills in the parameters of a fit whose model, coefficients, values and residual are there, with
// block-robust standard deviations; with 0 where the slopes have no columns. Throws Refusal where
// nothing determines a shape.
void add_uncertainty(FitResult& fit, const Joint& joint);

} // namespace servoid
