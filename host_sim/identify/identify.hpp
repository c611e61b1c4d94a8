// Inertia, viscous friction and constant torque of a capture, by the firmware core itself.
#pragma once

#include "capture/capture.hpp"
#include "compare/motion.hpp"
#include "effects/effect.hpp"
#include "identify/core_window.hpp"

#include <optional>
#include <vector>

namespace servoid {

struct IdentifyOptions {
    std::vector<double> frequencies_Hz; // empty: the fundamental of the move
    // Window in periods after the capture's first row, in the paper's words: from the end of the
    // 8th to the end of the 10th period. Where the capture is shorter, its last two.
    std::optional<double> first_period, last_period;
    sid_bin_method_t method = SID_BIN_CUBIC;
    Input input = Input::automatic;
    const Model* model = nullptr; // its Coulomb friction is taken out of the answer
};

// One frequency. Viscous friction holds what the fundamental sees: with Coulomb friction Tc that
// the model does not know, D + 4Tc/(πωA).
struct Identification {
    double frequency_Hz = 0, first_period = 0, last_period = 0;
    Estimate inertia, viscous, constant_torque; // std from the noise next to the frequency
    double position_amplitude = 0, torque_amplitude = 0;
    double coulomb_leak = 0; // kg·m² that the model's Coulomb friction put on J; already taken out
    sid_reason_t reason = SID_NOT_RUN;
};

// Throws Refusal where the core gives a reason instead of an inertia, or there is no period.
std::vector<Identification> identify(const Capture& capture, const IdentifyOptions& options);

// One answer from several frequencies: means weighted with 1/std²; where one of the deviations is
// not known (NaN), plain means, and theirs is not known either.
Identification combined(const std::vector<Identification>& all);

} // namespace servoid
