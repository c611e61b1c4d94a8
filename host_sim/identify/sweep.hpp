// The paper's experiment over frequency on the simulated drive, and beyond it: one inertia from all
// frequencies together with the elastic bias removed.
#pragma once

#include "effects/effect.hpp"
#include "plant/session.hpp"

#include <optional>
#include <vector>

namespace servoid {

struct SweepOptions {
    double from_Hz = 10, to_Hz = 200, step_Hz = 10;
    double amplitude = 1; // of the reference, rad or m
    double torque_noise = 0;
    unsigned long seed = 1;
    SessionOptions session;
    double encoder_bits = 0; // 0: the model's own sensor
};

struct SweepPoint {
    SessionResult answer;
    double inertia_clean = 0; // less what the model's Coulomb friction put on it
    double inertia_std = 0;   // from the noise beside the frequency
    double error_percent = 0; // (J − J*)/J*·100, eq. (15), of the answer
};

struct CorrectedInertia {
    Estimate inertia;
    // Antiresonance that the bias implies; nothing where no bias is seen.
    std::optional<Estimate> antiresonance_Hz;
    double scatter = 0; // rms of (J_i − fit)/J
};

struct Sweep {
    std::vector<SweepPoint> points;
    CorrectedInertia corrected;
};

Sweep sweep(const Model& model, const SweepOptions& options);

// Least squares over frequency of eq. (7)'s real part,
//   J_i = J·(1 − ω²/ωr²)/(1 − ω²/ωa²),
// in J, 1/ωa² and 1/ωr² (damping moves it by less than 0.1 % below half of ωa). Where J alone
// explains the points as well, it is fitted alone.
CorrectedInertia remove_elastic_bias(const std::vector<double>& frequency_Hz,
                                     const std::vector<double>& inertia,
                                     const std::vector<double>& std);

} // namespace servoid
