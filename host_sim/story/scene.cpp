#include "story/scene.hpp"

#include "compare/against.hpp"
#include "compare/regression.hpp"

#include <algorithm>

namespace servoid {

using Vector = Eigen::VectorXd;

std::string Scene::unit(Quantity quantity) const {
    return unit_of(quantity, model.motion, captures.front().motion.capture->torque_in_ampere);
}

const SceneCapture& Scene::longest() const {
    return *std::max_element(captures.begin(), captures.end(),
                             [](const SceneCapture& a, const SceneCapture& b) {
                                 return a.motion.grid.count < b.motion.grid.count;
                             });
}

Scene scene_of(const Model& model, const std::vector<PreparedMotion>& motions,
               const Homing& homing) {
    Scene out{model, {}};
    for (const PreparedMotion& m : motions) {
        const Model here = at_zero(model, homing.of(out.captures.size()));
        out.captures.push_back({m, here, delivered_torque(here, m), model_torque(here, m)});
    }
    return out;
}

std::vector<Vector> residuals_of(const Scene& scene) {
    std::vector<Vector> out;
    for (const SceneCapture& c : scene.captures)
        out.push_back(c.residual());
    return out;
}

VariableName name_of(Against against, const Scene& scene) {
    switch (against) {
    case Against::position:
        return {"position", scene.unit(Quantity::position)};
    case Against::time:
        return {"time", "s"};
    case Against::acceleration:
        return {"acceleration", scene.unit(Quantity::acceleration)};
    case Against::torque:
        return {"model torque", scene.unit(Quantity::torque)};
    case Against::torque_rate:
        return {"change of torque", scene.unit(Quantity::torque) + "/s"};
    case Against::in_phase:
    case Against::quadrature:
        return {"frequency", "Hz"};
    case Against::velocity:
        break;
    }
    return {"velocity", scene.unit(Quantity::velocity)};
}

std::vector<Point> points_against(Against against, const Scene& scene,
                                  const std::vector<Vector>& value) {
    std::vector<Point> out;
    for (size_t i = 0; i < scene.captures.size(); ++i) {
        const SceneCapture& c = scene.captures[i];
        const Vector x = variable_of(against, c.motion, c.model_torque);
        if (x.size() != value[i].size()) return {}; // no position was recorded
        for (Eigen::Index k = 0; k < x.size(); ++k)
            if (c.motion.used[size_t(k)]) out.emplace_back(x[k], value[i][k]);
    }
    return out;
}

} // namespace servoid
