// The paper's two systems, and the numbers of its tables that tests compare with.
#pragma once

#include "model/model.hpp"
#include "paper/figure.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace servoid::paper {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRated = 0.637;   // N·m
constexpr double kSample = 125e-6; // s

inline Model system(int number) {
    return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system" +
                      std::to_string(number) + ".toml");
}

inline Model without(Model model, const std::string& effect) {
    std::erase_if(model.effects, [&](const EffectTerm& term) { return term.name == effect; });
    return model;
}

inline Model with_bits(Model model, int bits) {
    model.sensor.position_per_count = kTurn / std::exp2(bits);
    return model;
}

// Table II, written down once more: the test must not read its truth from the file it tests.
constexpr double kInertia1 = 0.116e-4, kInertia2 = 0.556e-4;
constexpr double kAntiresonance_Hz = 402.3, kResonance_Hz = 628.9, kDamping = 0.05;

// What the fundamental of an elastic axis says of its inertia, over the inertia, less one:
// Re{1/(G(jω)·(jω)²)}/J − 1 with eq. (7).
inline double elastic_bias(double frequency_Hz) {
    using Complex = std::complex<double>;
    const Complex s(0, kTurn * frequency_Hz);
    const double a = kTurn * kAntiresonance_Hz, r = kTurn * kResonance_Hz;
    const Complex plant = r * r / (a * a) * (s * s + 2 * kDamping * a * s + a * a) /
                          (s * s + 2 * kDamping * r * s + r * r) / (kInertia2 * s * s);
    return (1.0 / (plant * s * s)).real() / kInertia2 - 1;
}

} // namespace servoid::paper
