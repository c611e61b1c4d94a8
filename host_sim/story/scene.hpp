// What a model leaves of every capture, on its grid: what all views of the story are drawn from.
#pragma once

#include "compare/homing.hpp"
#include "compare/motion.hpp"
#include "story/bins.hpp"

#include <string>
#include <vector>

namespace servoid {

struct SceneCapture {
    const PreparedMotion& motion;
    Model model;                             // as this capture's position zero meets it
    Eigen::VectorXd delivered, model_torque; // on the grid
    Eigen::VectorXd residual() const { return delivered - model_torque; }
};

struct Scene {
    const Model& model;
    std::vector<SceneCapture> captures;
    std::string unit(Quantity quantity) const;
    const SceneCapture& longest() const; // most points: the one that spectra are made of
};

Scene scene_of(const Model& model, const std::vector<PreparedMotion>& motions,
               const Homing& homing);

std::vector<Eigen::VectorXd> residuals_of(const Scene& scene); // one a capture

// What a residual is drawn against.
struct VariableName {
    std::string name, unit;
};
VariableName name_of(Against against, const Scene& scene);

// The used instants of all captures: where they are, and `value` there (one vector a capture).
std::vector<Point> points_against(Against against, const Scene& scene,
                                  const std::vector<Eigen::VectorXd>& value);

} // namespace servoid
