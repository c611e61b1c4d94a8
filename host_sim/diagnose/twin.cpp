#include "diagnose/twin.hpp"

#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/homing_search.hpp"
#include "compare/linear_fit.hpp"
#include "compare/loop_twin.hpp"
#include "compare/noise.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/evidence.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace servoid {

namespace {

constexpr int kArtifactTwins = 3; // their mean is taken: noise of the sensors is in each
constexpr int kNoiseTwins = 2;
constexpr double kExplainsAll = 0.9;  // of the residual's power: no other twin is asked
constexpr double kWorthARound = 0.97; // of the error before it

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// A model that is far from the truth may leave its reference: its twin says nothing.
bool moves_alike(const PreparedMotion& twin, const PreparedMotion& measured) {
    const double ratio = rms(twin.velocity) / rms(measured.velocity);
    return std::isfinite(ratio) && ratio > 0.7 && ratio < 1.4;
}

Vector residual_of(const HomedModel& model, const TwinSet& twins) {
    Eigen::Index rows = 0, row = 0;
    for (const PreparedMotion& m : twins.motions)
        rows += m.used_count();
    Vector out(rows);
    for (size_t i = 0; i < twins.motions.size(); ++i) {
        const PreparedMotion& m = twins.motions[i];
        const Vector all = residual_torque(model.at(i), m);
        for (Eigen::Index k = 0; k < all.size(); ++k)
            if (m.used[size_t(k)]) out[row++] = m.rests[size_t(k)] ? 0 : all[k];
    }
    return out;
}

// Size of a residual that may have a few large excursions.
double robust_rms(const Vector& x) {
    if (x.size() == 0) return 0;
    std::vector<double> size(x.begin(), x.end());
    for (double& s : size)
        s = std::abs(s);
    std::nth_element(size.begin(), size.begin() + long(size.size() / 2), size.end());
    return std::min(rms(x), 1.4826 * size[size.size() / 2]);
}

// What the model leaves along twins of its own: their mean, and the power of what chance leaves in
// it. Empty where there are none. Without noise all twins are the same.
struct Left {
    Vector mean;
    double chance = 0; // ‖·‖²
};

Left left_by_twins(const HomedModel& model, const std::vector<PreparedMotion>& motions,
                   double noise) {
    const int count = noise > 0 ? kArtifactTwins : 1;
    Vector sum;
    double powers = 0;
    for (int i = 0; i < count; ++i) {
        const auto twins = make_twins(model, motions, noise, 101 + unsigned(i));
        if (!twins) return {};
        const Vector one = residual_of(model, *twins);
        sum = i ? Vector(sum + one) : one;
        powers += one.squaredNorm();
    }
    Left out{sum / count, 0};
    if (count > 1) out.chance = (powers / count - out.mean.squaredNorm()) / (count - 1);
    return out;
}

// An artifact as far as the residual shows it, beyond what the fit could take up.
struct Shown {
    Vector artifact;
    double explained = 0; // of the residual's power
    double doubt = 0;     // rms of what of it the residual does not confirm
};

Shown as_shown(const Vector& residual, const Left& by_twins, const Matrix& slopes) {
    const Vector& artifact = by_twins.mean;
    if (artifact.size() == 0) return {};
    const Vector scale = slopes.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Matrix x = slopes * scale.asDiagonal();
    Matrix gram = x.transpose() * x;
    gram.diagonal().array() += 1e-9;
    const Eigen::LDLT<Matrix> solver(gram);
    const Vector left = artifact - x * solver.solve(x.transpose() * artifact);
    const Vector seen = residual - x * solver.solve(x.transpose() * residual);
    const double power = left.squaredNorm(), together = left.dot(seen);
    const double share = power > 0 ? std::clamp(together / power, 0.0, 1.0) : 0;
    const double explained = share * (2 * together - share * power);
    const double doubt =
        std::sqrt((1 - share) * std::max(0.0, power - by_twins.chance) / double(left.size()));
    return {share * artifact, explained / std::max(1e-300, seen.squaredNorm()), doubt};
}

// The artifact along twins with all of the residual as their noise, or along one without any: a
// record with little noise sticks and slips in its own places only.
Shown artifact_in(const FitResult& fitted, Assembler& assembler) {
    const Vector raw = fitted.residual + fitted.artifact;
    const Matrix slopes = joint_slopes(fitted, assembler);
    const auto along = [&](double noise) {
        return as_shown(
            raw, left_by_twins({fitted.model, fitted.homing}, assembler.motions(), noise), slopes);
    };
    const Shown quiet = along(0);
    if (quiet.explained > kExplainsAll) return quiet;
    const Shown noisy = along(robust_rms(fitted.residual));
    return quiet.explained > noisy.explained ? quiet : noisy;
}

// A fit may end where no axis is (a resonance below its antiresonance): it has no twin.
std::optional<Capture> simulated(const Model& model, const Capture& recorded,
                                 const TwinNoise& noise) {
    try {
        return loop_twin(model, recorded, noise);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

// One round: the artifact of the fitted model out of the torque, and the fit again.
std::optional<FitResult> freed_once(const FitResult& fitted, Assembler& assembler) {
    const Shown shown = artifact_in(fitted, assembler);
    if (shown.artifact.size() == 0) return std::nullopt;
    assembler.set_artifact(shown.artifact);
    try {
        FitResult out = fit(fitted.model, assembler, going_on_from(fitted));
        out.doubt = shown.doubt / rms(out.torque);
        return out;
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

} // namespace

std::optional<TwinSet> make_twins(const HomedModel& model,
                                  const std::vector<PreparedMotion>& motions, double noise,
                                  unsigned long seed) {
    TwinSet out;
    for (size_t i = 0; i < motions.size(); ++i) {
        const PreparedMotion& m = motions[i];
        if (m.input != Input::reference) return std::nullopt;
        Capture recorded = *m.capture;
        recorded.period_s = m.period_s;
        const TwinNoise white{noise / m.low_pass->noise_gain(0), seed + 1000 * i};
        std::optional<Capture> twin = simulated(model.at(i), recorded, white);
        if (!twin) return std::nullopt;
        out.captures.push_back(std::make_unique<Capture>(std::move(*twin)));
        out.motions.push_back(prepare_like(m, *out.captures.back()));
        if (!moves_alike(out.motions.back(), m)) return std::nullopt;
    }
    return out;
}

FitResult without_artifact(const FitResult& fitted, Assembler& assembler, int rounds) {
    FitResult best = fitted;
    for (int i = 0; i < rounds; ++i) {
        std::optional<FitResult> next = freed_once(best, assembler);
        if (!next) break;
        const double gain = next->torque_error / best.torque_error;
        best.doubt = next->doubt;
        if (gain < 1) best = std::move(*next);
        if (gain > kWorthARound) break;
    }
    assembler.set_artifact(best.artifact);
    assembler.set_homing(best.homing);
    // What the method leaves may have hidden how far the zeros are apart.
    const FitOptions options = going_on_from(best);
    return home_again(std::move(best), assembler, options);
}

std::optional<double> gain_from_noise(const FitResult& fitted, const Effect& effect,
                                      Assembler& assembler) {
    double most = 0;
    for (int i = 0; i < kNoiseTwins; ++i) {
        const auto twins = make_twins({fitted.model, fitted.homing}, assembler.motions(),
                                      rms(fitted.residual), 201 + unsigned(i));
        if (!twins) return std::nullopt;
        Assembler own(twins->motions);
        own.set_artifact(fitted.artifact);
        own.set_homing(fitted.homing);
        try {
            const FitResult before = fit(fitted.model, own);
            const FitResult after = fit_with(before, effect, own);
            most =
                std::max(most, std::log(held_out_error(before, own) / held_out_error(after, own)));
        } catch (const Refusal&) {
        }
    }
    return most;
}

} // namespace servoid
