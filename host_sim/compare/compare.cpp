#include "compare/compare.hpp"

#include "compare/loop_view.hpp"
#include "compare/regression.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

struct Powers {
    double residual = 0, torque = 0;
    long used = 0, all = 0;
};

Powers powers_of(const PreparedMotion& m, const Vector& residual) {
    Powers p;
    for (Eigen::Index k = 0; k < residual.size(); ++k) {
        ++p.all;
        if (!m.used[size_t(k)]) continue;
        p.residual += residual[k] * residual[k];
        p.torque += m.torque[k] * m.torque[k];
        ++p.used;
    }
    return p;
}

// Shares of the whole from shares of each part, weighted by the part's power and size.
void merge(std::vector<Regime>& all, const std::vector<Regime>& part, double power_weight,
           double sample_weight) {
    for (const Regime& r : part) {
        auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Regime& a) { return a.regime == r.regime; });
        if (found == all.end()) found = all.insert(all.end(), {r.group, r.regime, 0, 0});
        found->residual_share += power_weight * r.residual_share;
        found->sample_share += sample_weight * r.sample_share;
    }
}

std::optional<LoopError> loop_of_all(const Model& model,
                                     const std::vector<PreparedMotion>& motions) {
    LoopError sum;
    for (const PreparedMotion& m : motions) {
        const std::optional<LoopError> one = loop_view(model, *m.capture);
        if (!one) return std::nullopt;
        sum.torque_error += one->torque_error * one->torque_error;
        sum.position_error += one->position_error * one->position_error;
    }
    const double n = double(motions.size());
    return LoopError{std::sqrt(sum.torque_error / n), std::sqrt(sum.position_error / n)};
}

} // namespace

Vector residual_torque(const Model& model, const PreparedMotion& motion) {
    return delivered_torque(model, motion) - model_torque(model, motion);
}

std::vector<PreparedMotion> prepare_all(std::span<const Capture> captures,
                                        const MotionOptions& options) {
    std::vector<PreparedMotion> out;
    for (const Capture& capture : captures)
        out.push_back(prepare_motion(capture, options));
    return out;
}

Comparison compare(const Model& model, const std::vector<PreparedMotion>& motions) {
    Comparison out;
    std::vector<Vector> residuals;
    std::vector<Powers> powers;
    Powers total;
    for (const PreparedMotion& m : motions) {
        residuals.push_back(residual_torque(model, m));
        powers.push_back(powers_of(m, residuals.back()));
        total.residual += powers.back().residual, total.torque += powers.back().torque;
        total.used += powers.back().used, total.all += powers.back().all;
    }
    double noise = 0, repeatable = 0;
    bool all_repeat = true;
    for (size_t i = 0; i < motions.size(); ++i) {
        const PreparedMotion& m = motions[i];
        const NoiseFloor floor = noise_floor(m, residuals[i], model.inertia);
        noise += floor.ratio * floor.ratio * powers[i].torque;
        repeatable += floor.repeatable_share * powers[i].residual;
        all_repeat &= floor.from_repetition;
        out.floor.periods += floor.periods;
        merge(out.where, where_it_fails(m, residuals[i]), powers[i].residual / total.residual,
              double(powers[i].used) / double(total.used));
        out.samples += long(m.capture->rows());
        out.duration_s += m.capture->time_s.back() - m.capture->time_s.front();
        out.band_Hz = std::max(out.band_Hz, m.band_Hz);
        out.torque_name = m.torque_name;
    }
    out.torque_error = std::sqrt(total.residual / total.torque);
    out.floor.ratio = std::sqrt(noise / total.torque);
    out.floor.from_repetition = all_repeat;
    out.floor.repeatable_share = all_repeat ? repeatable / total.residual : NAN;
    out.samples_used_share = double(total.used) / double(total.all);
    out.loop = loop_of_all(model, motions);
    return out;
}

} // namespace servoid
