#include "identify/identify.hpp"

#include "common/error.hpp"
#include "compare/low_pass.hpp"
#include "compare/noise.hpp"
#include "compare/period.hpp"
#include "compare/solve.hpp"
#include "compare/spectrum.hpp"
#include "effects/catalogue.hpp"
#include "identify/noise_beside.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

Vector as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
}

const char* what_to_record(sid_reason_t reason) {
    switch (reason) {
    case SID_NO_EXCITATION:
        return "a larger amplitude or a lower frequency";
    case SID_WINDOW_TOO_SHORT:
        return "at least two periods after the start, ten or more rows each";
    case SID_STROKE_CLIPPED:
        return "a smaller stroke";
    case SID_NEGATIVE_INERTIA:
        return "torque that is positive where it speeds the axis up (is its sign reversed?)";
    case SID_ILL_CONDITIONED:
        return "a longer window";
    default:
        return "a periodic move in both directions";
    }
}

void refuse_one_way(const Capture& capture) {
    const Vector p = as_vector(capture.position);
    const double travel = p.maxCoeff() - p.minCoeff();
    if (travel <= 2 * capture.position_quantum || travel <= 0)
        throw Refusal(capture.path + ": the axis does not move",
                      "a periodic move in both directions");
    const Vector d = p.tail(p.size() - 1) - p.head(p.size() - 1);
    const double forward = d.cwiseMax(0).sum(), reverse = -d.cwiseMin(0).sum();
    if (std::min(forward, reverse) < 0.05 * std::max(forward, reverse))
        throw Refusal(capture.path + ": the axis moves one way only",
                      "a periodic move in both directions, such as a sine");
}

std::vector<double> frequencies(const Capture& capture, const IdentifyOptions& options) {
    if (!options.frequencies_Hz.empty()) return options.frequencies_Hz;
    if (const std::optional<double> period = find_period(capture)) return {1 / *period};
    const double f = strongest_line_Hz(as_vector(capture.position), capture.sample_time_s);
    if (f <= 0)
        throw Refusal(capture.path + ": no period is seen in the move",
                      "a periodic move, or name its frequency with --frequency");
    return {f};
}

// The window in periods: what was asked for, the paper's 8th to 10th, or the last two there are.
// Returns whether the frequency is one line of a move of many.
bool choose_periods(const Capture& capture, const IdentifyOptions& options, Identification& out) {
    const double length_s = double(capture.rows()) * capture.sample_time_s;
    // A record of ten periods is up to half a row short of them.
    const double rounding = 0.5 * capture.sample_time_s * out.frequency_Hz + 1e-6;
    const double periods = length_s * out.frequency_Hz + rounding;
    const double whole = std::floor(periods);
    const double usual = whole >= 10 ? 10 : whole;
    // A line of a move of many lines: the others fall out over whole periods of the move only.
    const double move = capture.period_s.value_or(0) * out.frequency_Hz;
    const bool line_of_many = move > 1.5 && move <= whole;
    out.last_period =
        options.last_period.value_or(line_of_many ? std::floor(whole / move + 1e-6) * move : usual);
    out.first_period = options.first_period.value_or(
        std::max(0.0, out.last_period -
                          (line_of_many ? std::min(2.0, std::floor(whole / move)) * move : 2)));
    if (whole < 1)
        throw Refusal(fmt::format("{}: {:.3g} s hold less than one period of {:.4g} Hz",
                                  capture.path, length_s, out.frequency_Hz),
                      "at least two whole periods");
    if (!(out.first_period >= 0 && out.last_period > out.first_period))
        throw UsageError("--window wants FIRST,LAST with 0 ≤ FIRST < LAST");
    if (out.last_period > periods)
        throw Refusal(fmt::format("{}: the window ends after period {:.4g}, the capture after "
                                  "{:.4g}",
                                  capture.path, out.last_period, periods),
                      "a longer capture, or ask for an earlier --window");
    return line_of_many;
}

// (XᵀX)⁻¹ of the cosine for [cos, sin, 1, t, t², t³], times half the count: 1 for a plain sine.
double inflation(const WindowTask& task) {
    const Eigen::Index n = task.count;
    const int trend = task.method == SID_BIN_PLAIN_DFT ? 0 : 4 - int(task.method);
    Eigen::MatrixXd x(n, 2 + trend);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double p = kTurn * task.frequency_Hz * task.scale.sample_time_s * double(i);
        const double t = 2 * double(i) / double(n - 1) - 1;
        x(i, 0) = std::cos(p), x(i, 1) = std::sin(p);
        for (int k = 0; k < trend; ++k)
            x(i, 2 + k) = std::pow(t, k);
    }
    const Eigen::MatrixXd inverse = solve_symmetric(
        x.transpose() * x, Eigen::MatrixXd(Eigen::MatrixXd::Identity(x.cols(), x.cols())));
    return std::max(inverse(0, 0), inverse(1, 1)) * double(n) / 2;
}

// The record with its first period put before it and its last one behind it, each moved to join: a
// kernel that reaches past the ends finds the motion going on.
Vector continued(const Vector& x, Eigen::Index period, Eigen::Index reach) {
    const Eigen::Index n = x.size();
    Vector out(n + 2 * reach);
    out.segment(reach, n) = x;
    for (Eigen::Index i = 1; i <= reach; ++i) {
        out[reach - i] = x[0] + x[period - i] - x[period];
        out[reach + n - 1 + i] = x[n - 1] + x[n - 1 - period + i] - x[n - 1 - period];
    }
    return out;
}

// The velocity with the widest band whose noise stays small against the velocity itself: its sign
// must turn at the right instant, and a narrow band moves the turn.
MotionView velocity_of(const Capture& capture, const Vector& position, double frequency_Hz) {
    const double noise = sample_noise(position, capture.position_quantum);
    const double step = capture.sample_time_s;
    // The kernel reaches half a period where the band is six times the frequency.
    const auto period = std::min(position.size() - 1, std::lround(1 / (frequency_Hz * step)));
    const Eigen::Index reach =
        std::min<Eigen::Index>(period, std::lround(0.7 * double(period)) + 12);
    const Vector longer = continued(position, period, reach);
    MotionView out; // directions at instants, not over a sample's width: see held()
    out.acceleration = Vector::Zero(position.size());
    for (double band = 0.3 / step;; band /= 1.3) {
        const LowPass low_pass(step, band);
        out.velocity = low_pass.apply(longer, {double(reach) * step, step, position.size()}, 1);
        out.velocity_noise = noise * low_pass.noise_gain(1);
        const double rms = out.velocity.norm() / std::sqrt(double(out.velocity.size()));
        if (out.velocity_noise < 0.02 * rms || band < 6 * frequency_Hz) return out;
    }
}

// Friction averaged over each hold: where the velocity changes its sign on the way, by the share of
// the hold on either side.
Vector held(const Vector& friction, const Vector& velocity) {
    Vector out = friction;
    for (Eigen::Index k = 0; k + 1 < friction.size(); ++k) {
        const double a = std::abs(velocity[k]), b = std::abs(velocity[k + 1]);
        const bool turns = velocity[k] * velocity[k + 1] < 0;
        const double share = turns ? a / (a + b) : 0.5;
        out[k] = share * friction[k] + (1 - share) * friction[k + 1];
    }
    return out;
}

// What the model's Coulomb friction puts on J and D, by the same core over the same window.
WindowResult coulomb_share(const Capture& capture, const Vector& position, WindowTask task,
                           const Model& model) {
    const MotionView motion = velocity_of(capture, position, task.frequency_Hz);
    Vector torque = Vector::Zero(position.size());
    for (const EffectTerm& term : model.effects) {
        if (!term.name.starts_with("coulomb")) continue;
        const Effect* effect = find_effect(term.name);
        torque += effect->columns(term, motion) * effect->linear(term);
    }
    if (torque.cwiseAbs().maxCoeff() <= 0) return {};
    task.scale.full_torque = torque.cwiseAbs().maxCoeff() / 4;
    task.timing = SID_TORQUE_HELD_NEXT;
    return project(held(torque, motion.velocity), position, task);
}

double coulomb_of(const Model& model) {
    double sum = 0;
    for (const EffectTerm& term : model.effects)
        if (term.name.starts_with("coulomb"))
            for (const auto& [key, value] : term.parameters)
                sum = std::max(sum, value);
    return sum;
}

// The instant at which friction turns is known to a sample's width, h/√12; a turn that is δt off
// puts (4/π) Tc ω δt of torque in phase with the position.
double turning_std(const Model& model, const Identification& one, const Capture& capture) {
    const double w = kTurn * one.frequency_Hz;
    return 4 / std::numbers::pi * coulomb_of(model) * capture.sample_time_s / std::sqrt(12.0) /
           (w * one.position_amplitude);
}

Identification identify_one(const Capture& capture, double frequency_Hz,
                            const IdentifyOptions& options) {
    Identification out;
    out.frequency_Hz = frequency_Hz;
    const bool line_of_many = choose_periods(capture, options, out);
    const TorqueChoice choice = choose_torque(capture, options.input);
    const Vector torque = as_vector(*choice.values), position = as_vector(capture.position);
    WindowTask task;
    task.frequency_Hz = frequency_Hz;
    // A trend would take up part of the other lines, which whole periods of the move keep out.
    task.method =
        line_of_many && options.method == SID_BIN_CUBIC ? SID_BIN_CONSTANT : options.method;
    task.timing = choice.held ? SID_TORQUE_HELD_NEXT : SID_TORQUE_SAMPLED;
    const double per_period = 1 / (frequency_Hz * capture.sample_time_s);
    task.first = std::lround(out.first_period * per_period);
    task.count = std::min<Eigen::Index>(
        std::lround((out.last_period - out.first_period) * per_period), torque.size() - task.first);
    const double rated = options.model ? options.model->drive.rated_torque : 0;
    task.scale = choose_scale(torque.segment(task.first, task.count),
                              position.segment(task.first, task.count), rated,
                              capture.position_quantum, capture.sample_time_s);
    const WindowResult core = run_window(torque, position, task);
    out.reason = core.reason;
    if (core.reason != SID_OK)
        throw Refusal(fmt::format("{}: {:.4g} Hz: {}", capture.path, frequency_Hz,
                                  sid_reason_text(core.reason)),
                      what_to_record(core.reason));
    const NoiseBeside noise = noise_beside(capture, frequency_Hz, options.input);
    const double window_s = double(task.count) * capture.sample_time_s;
    const double amplitude_std = std::sqrt(noise.density / window_s * inflation(task));
    const double w = kTurn * frequency_Hz;
    out.position_amplitude = core.position_amplitude;
    out.torque_amplitude = core.torque_amplitude;
    out.inertia = {core.inertia, amplitude_std / (w * w * core.position_amplitude)};
    out.viscous = {core.viscous, amplitude_std / (w * core.position_amplitude)};
    out.constant_torque = {noise.constant_torque, noise.constant_torque_std};
    if (options.model && coulomb_of(*options.model) > 0) {
        out.inertia.std = std::hypot(out.inertia.std, turning_std(*options.model, out, capture));
        const WindowResult leak = coulomb_share(capture, position, task, *options.model);
        out.coulomb_leak = leak.inertia;
        out.inertia.value -= leak.inertia;
        out.viscous.value -= leak.viscous;
    }
    return out;
}

} // namespace

std::vector<Identification> identify(const Capture& capture, const IdentifyOptions& options) {
    if (!capture.has_position())
        throw Refusal(capture.path + ": there is no position column", "the motor position");
    if (!capture.uniform)
        throw Refusal(capture.path + ": the rows are not evenly spaced in time",
                      "at the drive's own sample rate");
    refuse_one_way(capture);
    std::vector<Identification> out;
    for (double f : frequencies(capture, options)) {
        if (!(f > 0) || f >= 0.5 / capture.sample_time_s)
            throw UsageError(fmt::format("--frequency: {} Hz is not between 0 and half the sample "
                                         "rate",
                                         f));
        out.push_back(identify_one(capture, f, options));
    }
    return out;
}

Identification combined(const std::vector<Identification>& all) {
    if (all.size() == 1) return all.front();
    Identification out = all.front();
    const auto mean = [&](Estimate Identification::*field) {
        const bool known = std::all_of(all.begin(), all.end(), [&](const Identification& one) {
            return std::isfinite((one.*field).std);
        });
        double weight = 0, sum = 0;
        for (const Identification& one : all) {
            const double w = known ? 1 / std::max(1e-300, std::pow((one.*field).std, 2)) : 1;
            weight += w, sum += w * (one.*field).value;
        }
        return Estimate{sum / weight,
                        known ? 1 / std::sqrt(weight) : std::numeric_limits<double>::quiet_NaN()};
    };
    out.inertia = mean(&Identification::inertia);
    out.viscous = mean(&Identification::viscous);
    return out;
}

} // namespace servoid
