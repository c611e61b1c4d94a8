// A rigid axis in closed form: its torque along any motion, and the model that has these terms.
#pragma once

#include "model/model.hpp"
#include "unit/motion_helpers.hpp"

#include <map>
#include <string>

namespace servoid {

inline constexpr double kInertia = 0.012, kViscous = 0.03, kOffset = -0.05; // kg·m², N·m·s/rad, N·m

inline double rigid_torque(const Kinematics& k) {
    return kInertia * k.acceleration + kViscous * k.velocity + kOffset;
}

inline EffectTerm term(const std::string& name, const std::map<std::string, double>& parameters) {
    EffectTerm out;
    out.name = name, out.parameters = parameters;
    return out;
}

inline Model rigid_axis(double inertia, double viscous, double offset) {
    Model model;
    model.inertia = inertia;
    model.effects = {term("viscous", {{"coefficient", viscous}}),
                     term("constant_torque", {{"torque", offset}})};
    return model;
}

} // namespace servoid
