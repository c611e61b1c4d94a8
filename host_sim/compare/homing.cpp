#include "compare/homing.hpp"

#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

std::vector<size_t> Homing::all_moved() const {
    std::vector<size_t> out;
    for (size_t i = 0; i < offset.size(); ++i)
        if (moved(i)) out.push_back(i);
    return out;
}

std::vector<PositionWave> waves_of(const Model& model) {
    std::vector<PositionWave> out;
    Eigen::Index next = 1; // after the inertia
    for (const EffectTerm& term : model.effects) {
        const Effect* effect = find_effect(term.name);
        if (!effect) continue; // who assembles it says so
        const double kappa = effect->phase_per_position(term, model.motion);
        if (kappa > 0) out.push_back({next, kappa});
        next += effect->linear_count(term);
    }
    return out;
}

double fastest_wave(const std::vector<PositionWave>& waves) {
    double out = 0;
    for (const PositionWave& wave : waves)
        out = std::max(out, wave.kappa);
    return out;
}

Model at_zero(Model model, double offset) {
    if (offset == 0) return model;
    for (EffectTerm& term : model.effects)
        if (const Effect* effect = find_effect(term.name))
            if (const double kappa = effect->phase_per_position(term, model.motion); kappa > 0)
                term.parameters["phase"] += kappa * offset;
    return model;
}

void turn(Eigen::Ref<Matrix> columns, const std::vector<PositionWave>& waves, double offset) {
    for (const PositionWave& wave : waves) {
        const double c = std::cos(wave.kappa * offset), s = std::sin(wave.kappa * offset);
        auto sine = columns.col(wave.coefficient), cosine = columns.col(wave.coefficient + 1);
        const Vector was = sine;
        sine = c * was + s * cosine;
        cosine = c * cosine - s * was;
    }
}

Vector offset_slope(const Eigen::Ref<const Matrix>& turned, const std::vector<PositionWave>& waves,
                    const Vector& coefficients) {
    Vector out = Vector::Zero(turned.rows());
    for (const PositionWave& wave : waves) {
        const Eigen::Index at = wave.coefficient;
        out += wave.kappa *
               (coefficients[at] * turned.col(at + 1) - coefficients[at + 1] * turned.col(at));
    }
    return out;
}

} // namespace servoid
