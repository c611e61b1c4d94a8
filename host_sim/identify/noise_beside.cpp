#include "identify/noise_beside.hpp"

#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "compare/spectrum.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

Model rigid_axis_with_friction() {
    Model model;
    model.inertia = 1;
    for (const char* name : {"viscous", "coulomb", "constant_torque"}) {
        EffectTerm term;
        term.name = name;
        for (const ParameterInfo& p : find_effect(name)->info().parameters)
            term.parameters[p.key] = 0;
        model.effects.push_back(term);
    }
    return model;
}

double density_around(const Eigen::VectorXd& residual, double step_s, double frequency_Hz) {
    const Spectrum spectrum = power_spectrum(residual, step_s);
    const double length_s = double(residual.size()) * step_s;
    const double skirt = 2.5 / length_s; // the line under a Hann window
    double power = 0;
    int bins = 0;
    for (Eigen::Index k = 0; k < spectrum.power.size(); ++k) {
        const double f = double(k) * spectrum.step_Hz;
        if (f < 0.4 * frequency_Hz || f > 1.9 * frequency_Hz - skirt) continue;
        if (std::abs(f - frequency_Hz) < skirt) continue;
        power += spectrum.power[k], ++bins;
    }
    return bins ? power / bins / spectrum.step_Hz : NAN;
}

} // namespace

NoiseBeside noise_beside(const Capture& capture, double frequency_Hz, Input input) try {
    MotionOptions options;
    options.input = input;
    // Wide enough for the skirt of the line, and for the kernel to take an eighth of the record.
    const double length_s = double(capture.rows()) * capture.sample_time_s;
    options.band_Hz =
        std::min(std::max(2.5 * frequency_Hz, 25 / length_s), 0.11 / capture.sample_time_s);
    const std::vector<PreparedMotion> motions = prepare_all(std::span(&capture, 1), options);
    const FitResult fitted = fit(rigid_axis_with_friction(), motions);
    const Eigen::VectorXd residual = residual_torque(fitted.model, motions.front());
    NoiseBeside out;
    out.density = density_around(residual, motions.front().grid.step_s, frequency_Hz);
    out.constant_torque = fitted.values[3];
    out.constant_torque_std = fitted.std[3];
    return out;
} catch (const Refusal&) {
    return {NAN, NAN, NAN}; // a motion of a few counts: an answer without a known error
}

} // namespace servoid
