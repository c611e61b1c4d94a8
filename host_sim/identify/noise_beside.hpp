// How much noise torque lies next to the frequency of the excitation.
#pragma once

#include "capture/capture.hpp"
#include "compare/motion.hpp"

namespace servoid {

struct NoiseBeside {
    double density = 0; // of the equation error T − Ja − Dv − Tc·sgn v − w, (N·m)²/Hz
    double constant_torque = 0; // w of that fit
    double constant_torque_std = 0;
};

// The equation error knows no transient: start and stop obey the equation too. Its density between
// 0.4 and 1.9 of the frequency, the line itself left out, is what disturbs the fundamental. NaN
// where the record is too short or the motion too small to tell.
NoiseBeside noise_beside(const Capture& capture, double frequency_Hz, Input input);

} // namespace servoid
