#include "compare/compare.hpp"

#include "compare/by_value.hpp"
#include "compare/homing_search.hpp"
#include "compare/lag.hpp"
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
    return {m.used_power(residual), m.used_power(m.torque), m.used_count(), residual.size()};
}

// One capture with what the model leaves of it.
struct Part {
    const PreparedMotion* motion;
    Vector model_torque, residual;
    Powers powers;
    NoiseFloor floor;
};

std::vector<Part> parts_of(const Model& model, const std::vector<PreparedMotion>& motions,
                           const Homing& homing) {
    std::vector<Part> out;
    for (const PreparedMotion& m : motions) {
        const Model here = at_zero(model, homing.of(out.size()));
        Part part{&m, model_torque(here, m), delivered_torque(here, m), {}, {}};
        part.residual -= part.model_torque;
        part.powers = powers_of(m, part.residual);
        part.floor = noise_floor(m, part.residual, model.inertia);
        out.push_back(std::move(part));
    }
    return out;
}

Powers sum_of(const std::vector<Part>& parts) {
    Powers total;
    for (const Part& part : parts) {
        total.residual += part.powers.residual, total.torque += part.powers.torque;
        total.used += part.powers.used, total.all += part.powers.all;
    }
    return total;
}

NoiseFloor pooled_floor(const std::vector<Part>& parts) {
    NoiseFloor out;
    out.from_repetition = true;
    double noise = 0, repeatable = 0;
    for (const Part& part : parts) {
        const NoiseFloor& floor = part.floor;
        noise += floor.ratio * floor.ratio * part.powers.torque;
        repeatable += floor.repeatable_share * part.powers.residual;
        out.from_repetition = out.from_repetition && floor.from_repetition;
        out.periods += floor.periods;
    }
    const Powers total = sum_of(parts);
    out.ratio = std::sqrt(noise / total.torque);
    out.repeatable_share = out.from_repetition ? repeatable / total.residual : NAN;
    return out;
}

std::vector<ResidualView> views_of(const std::vector<Part>& parts) {
    std::vector<ResidualView> out;
    for (const Part& part : parts)
        out.push_back({*part.motion, part.residual, part.model_torque});
    return out;
}

std::vector<PeriodicResidual> periodic_of(const std::vector<Part>& parts) {
    std::vector<PeriodicResidual> out;
    for (const Part& part : parts)
        out.push_back({*part.motion, part.residual, part.floor.periods});
    return out;
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

std::optional<LoopError> loop_of_all(const Model& model, const std::vector<PreparedMotion>& motions,
                                     const Homing& homing) {
    LoopError sum;
    for (size_t i = 0; i < motions.size(); ++i) {
        const std::optional<LoopError> one =
            loop_view(at_zero(model, homing.of(i)), *motions[i].capture);
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

NoiseFloor noise_floor_of_all(const Model& model, const std::vector<PreparedMotion>& motions,
                              const Homing& homing) {
    return pooled_floor(parts_of(model, motions, homing));
}

double torque_error_of(const Model& model, const std::vector<PreparedMotion>& motions,
                       size_t first) {
    const Homing homing = homing_against(model, motions, first);
    double residual = 0, torque = 0;
    for (size_t i = 0; i < motions.size(); ++i) {
        const PreparedMotion& m = motions[i];
        residual += m.used_power(residual_torque(at_zero(model, homing.of(i)), m));
        torque += m.used_power(m.torque);
    }
    return std::sqrt(residual / torque);
}

Comparison compare(const Model& model, const std::vector<PreparedMotion>& motions) {
    Comparison out;
    out.homing = homing_against(model, motions, 1);
    const std::vector<Part> parts = parts_of(model, motions, out.homing);
    const Powers total = sum_of(parts);
    for (const Part& part : parts) {
        const PreparedMotion& m = *part.motion;
        merge(out.where, where_it_fails(m, part.residual), part.powers.residual / total.residual,
              double(part.powers.used) / double(total.used));
        out.samples += long(m.capture->rows());
        out.duration_s += m.capture->time_s.back() - m.capture->time_s.front();
        if (m.band_Hz > out.band_Hz)
            out.band_Hz = m.band_Hz, out.band_limited_by = m.band_limited_by;
        out.torque_name = m.torque_name;
        out.torque_unit = unit_of(Quantity::torque, m.motion.kind, m.capture->torque_in_ampere);
    }
    const std::vector<Regime> by_value = where_by_value(views_of(parts));
    out.where.insert(out.where.end(), by_value.begin(), by_value.end());
    out.lines = lines_of(periodic_of(parts));
    out.lag_s = lag_of_torque(model, motions);
    out.floor = pooled_floor(parts);
    out.residual_rms = std::sqrt(total.residual / double(total.used));
    out.torque_error = std::sqrt(total.residual / total.torque);
    out.samples_used_share = double(total.used) / double(total.all);
    out.loop = loop_of_all(model, motions, out.homing);
    return out;
}

} // namespace servoid
