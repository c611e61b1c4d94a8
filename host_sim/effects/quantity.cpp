#include "effects/effect.hpp"

namespace servoid {

namespace {

// Torque recorded as a current without a torque constant: N·m and N become A.
std::string in_ampere(Quantity quantity, bool rotary) {
    switch (quantity) {
    case Quantity::torque:
        return "A";
    case Quantity::viscous:
        return rotary ? "A·s/rad" : "A·s/m";
    case Quantity::inertia:
        return rotary ? "A·s²/rad" : "A·s²/m";
    case Quantity::stiffness:
        return rotary ? "A/rad" : "A/m";
    case Quantity::quadratic_drag:
        return rotary ? "A·s²/rad²" : "A·s²/m²";
    default:
        return "";
    }
}

} // namespace

std::string unit_of(Quantity quantity, Motion motion, bool ampere) {
    const bool rotary = motion == Motion::rotary;
    if (ampere)
        if (const std::string unit = in_ampere(quantity, rotary); !unit.empty()) return unit;
    switch (quantity) {
    case Quantity::torque:
        return rotary ? "N·m" : "N";
    case Quantity::viscous:
        return rotary ? "N·m·s/rad" : "N·s/m";
    case Quantity::inertia:
        return rotary ? "kg·m²" : "kg";
    case Quantity::position:
        return rotary ? "rad" : "m";
    case Quantity::velocity:
        return rotary ? "rad/s" : "m/s";
    case Quantity::acceleration:
        return rotary ? "rad/s²" : "m/s²";
    case Quantity::frequency:
        return "Hz";
    case Quantity::ratio:
        return "1";
    case Quantity::angle:
        return "rad";
    case Quantity::per_rev:
        return rotary ? "1/rev" : "1/m";
    case Quantity::time:
        return "s";
    case Quantity::stiffness:
        return rotary ? "N·m/rad" : "N/m";
    case Quantity::quadratic_drag:
        return rotary ? "N·m·s²/rad²" : "N·s²/m²";
    case Quantity::none:
        break;
    }
    return "";
}

} // namespace servoid
