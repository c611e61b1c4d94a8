#include "compare/motion.hpp"

#include "common/error.hpp"
#include "compare/noise.hpp"
#include "compare/period.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kSmoothing = 3.0;      // least band of the motion over the band of comparison
constexpr double kWidest = 0.3;         // of the sample rate: the widest band of the motion
constexpr double kVelocityNoise = 0.01; // of the rms velocity: what the widest band may let through
constexpr double kOversampling = 4.0;   // grid points per period of the band edge
constexpr double kRestShare = 0.05;     // a point that sees more rest than this is not used
constexpr double kHeldShare = 0.5;      // the same for what was taken out of it
constexpr double kLeastFree = 0.05;     // weight below which an acceleration is as good as none
constexpr double kShortestHeld = 0.02;  // periods of the band edge: shorter ones make no difference

using Vector = Eigen::VectorXd;

Vector as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
}

// Uneven times (a host loop): straight lines between the rows, on a grid of the median step.
Vector on_even_grid(const Capture& capture, const std::vector<double>& values) {
    if (capture.uniform) return as_vector(values);
    const double step = capture.sample_time_s, start = capture.time_s.front();
    const auto n = Eigen::Index((capture.time_s.back() - start) / step) + 1;
    Vector out(n);
    size_t row = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double t = start + double(i) * step;
        while (row + 2 < capture.rows() && capture.time_s[row + 1] < t)
            ++row;
        const double share =
            (t - capture.time_s[row]) / (capture.time_s[row + 1] - capture.time_s[row]);
        out[i] = values[row] + share * (values[row + 1] - values[row]);
    }
    return out;
}

// The highest band whose smoothing kernel still fits the sample rate.
double highest_band(double sample_time_s) { return 0.34 / sample_time_s / kSmoothing; }

Grid motion_grid(Eigen::Index rows, double sample_time_s, double margin_s) {
    const double step = sample_time_s;
    const double first = std::ceil(margin_s / step) * step;
    const double last = double(rows - 1) * step - margin_s;
    return {first, step, std::max<Eigen::Index>(0, Eigen::Index((last - first) / step) + 1)};
}

// The direction of the motion must turn at the right instant, and a narrow band moves the turn: as
// wide as the noise of the velocity allows.
double smoothing_band(const Capture& capture, const Vector& source, double noise, double band_Hz) {
    const int order = capture.has_position() ? 1 : 0;
    const double step = capture.sample_time_s;
    const Vector difference =
        order ? Vector(source.tail(source.size() - 1) - source.head(source.size() - 1)) / step
              : source;
    const double rms = difference.norm() / std::sqrt(double(difference.size()));
    double smoothing = std::max(kSmoothing * band_Hz, kWidest / step);
    while (smoothing > kSmoothing * band_Hz &&
           noise * LowPass(step, smoothing).noise_gain(order) > kVelocityNoise * rms)
        smoothing /= 1.3;
    return std::max(smoothing, kSmoothing * band_Hz);
}

// The acceleration of a motion without its held instants: smoothed after they are taken out, so
// that the jump at either end is not smeared over them.
void take_out_held(const Vector& position, const LowPass& smooth, const Grid& grid,
                   PreparedMotion& out) {
    const double step = out.motion.sample_time_s;
    Vector taken = out.held_weight.at(0, step, position.size());
    for (Eigen::Index i = 0; i < taken.size(); ++i) {
        const Eigen::Index k = std::clamp<Eigen::Index>(i, 1, position.size() - 2);
        taken[i] *= (position[k + 1] - 2 * position[k] + position[k - 1]) / (step * step);
    }
    out.held = out.held_weight.at(grid.start_s, step, grid.count);
    const Vector free = (1 - out.held.array()).max(kLeastFree).matrix();
    out.motion.acceleration =
        (out.motion.acceleration - smooth.apply(taken, grid)).cwiseQuotient(free);
}

HeldWeight find_held(const Vector& position, const PreparedMotion& out) {
    const double step = out.motion.sample_time_s;
    const double within = std::max(2.5 * out.motion.position_quantum, 6 * out.position_noise);
    const double width = std::max(0.5 / out.smoothing_Hz, 8 * step);
    return {held_intervals(position, step, within, kShortestHeld / out.band_Hz),
            0.5 / out.smoothing_Hz, width};
}

void differentiate(const Capture& capture, PreparedMotion& out) {
    const double step = capture.sample_time_s;
    const Vector source =
        on_even_grid(capture, capture.has_position() ? capture.position : capture.velocity);
    const int order = capture.has_position() ? 0 : 1;
    if (!(out.smoothing_Hz > 0)) {
        out.position_noise =
            sample_noise(source, order == 0 ? capture.position_quantum : capture.velocity_quantum);
        out.smoothing_Hz = smoothing_band(capture, source, out.position_noise, out.band_Hz);
    }
    const LowPass smooth(step, out.smoothing_Hz);
    const Grid grid = motion_grid(source.size(), step, smooth.half_length_s());
    MotionView& motion = out.motion;
    motion.sample_time_s = step;
    motion.band_Hz = out.band_Hz;
    motion.position_quantum = capture.position_quantum;
    motion.kind = capture.linear ? Motion::linear : Motion::rotary;
    motion.time_s =
        Vector::LinSpaced(grid.count, grid.start_s, grid.start_s + step * double(grid.count - 1));
    if (grid.count == 0) return;
    motion.velocity = smooth.apply(source, grid, 1 - order);
    motion.acceleration = smooth.apply(source, grid, 2 - order);
    motion.position = order == 0 ? smooth.apply(source, grid, 0) : Vector();
    out.motion_start_s = grid.start_s;
    motion.velocity_noise = out.position_noise * smooth.noise_gain(1 - order);
    out.held_weight = {}, out.held.resize(0);
    if (order == 0) out.held_weight = find_held(source, out); // a velocity of zero says not where
    if (!out.held_weight.empty()) take_out_held(source, smooth, grid, out);
}

// Instants that the band limit can reach; a whole number of them to a known period.
Grid comparison_grid(const PreparedMotion& prepared, double band_Hz) {
    const Capture& capture = *prepared.capture;
    const double margin = prepared.low_pass->half_length_s() + 1.5 * capture.sample_time_s +
                          std::abs(capture.torque_delay_s);
    const double first = prepared.motion_start_s + margin;
    const double last = prepared.motion_start_s +
                        double(prepared.motion.size() - 1) * capture.sample_time_s - margin;
    double step = 1 / (kOversampling * band_Hz);
    if (prepared.period_s) step = *prepared.period_s / std::ceil(*prepared.period_s / step);
    return {first, step, last > first ? Eigen::Index((last - first) / step) + 1 : 0};
}

// Where the axis is at rest, friction holds whatever it has to: such points say nothing of a law.
std::vector<bool> moving(const PreparedMotion& prepared) {
    const MotionView& motion = prepared.motion;
    const double threshold =
        std::max(4 * motion.velocity_noise, 1e-4 * motion.velocity.cwiseAbs().maxCoeff());
    Vector rest(motion.size());
    // A crossing of zero is no rest: only a stretch that lasts is.
    const auto shortest = Eigen::Index(0.25 / prepared.band_Hz / motion.sample_time_s) + 2;
    for (Eigen::Index i = 0; i < motion.size();) {
        Eigen::Index end = i;
        while (end < motion.size() && std::abs(motion.velocity[end]) < threshold)
            ++end;
        const bool rests = end - i >= shortest;
        for (; i < end; ++i)
            rest[i] = rests && !(prepared.held.size() && prepared.held[i] > 0) ? 1 : 0;
        if (i < motion.size()) rest[i++] = 0;
    }
    const Vector share = prepared.smooth(rest);
    const Vector held =
        prepared.held.size() ? prepared.smooth(prepared.held) : Vector::Zero(share.size());
    std::vector<bool> used(size_t(share.size()));
    for (Eigen::Index k = 0; k < share.size(); ++k)
        used[size_t(k)] = share[k] < kRestShare && held[k] < kHeldShare;
    return used;
}

void refuse_if_short(const PreparedMotion& prepared) {
    if (prepared.motion.size() > 0 && prepared.grid.count >= 16) return;
    throw Refusal(
        prepared.capture->path +
            fmt::format(": the capture is too short for a band of {:.3g} Hz", prepared.band_Hz),
        "at least 0.5 s of motion, or ask for a higher --band");
}

void refuse_if_still(const PreparedMotion& prepared) {
    const double top = prepared.motion.velocity.cwiseAbs().maxCoeff();
    const auto used = prepared.used_count();
    // A position that never changes still has the rounding of its own numbers.
    const Vector& position = prepared.motion.position;
    const double rounding =
        position.size() ? 1e-10 * position.cwiseAbs().maxCoeff() / prepared.motion.sample_time_s
                        : 0;
    if (top > 5 * prepared.motion.velocity_noise + rounding && used >= 16) return;
    throw Refusal(prepared.capture->path + ": the axis does not move",
                  "a periodic move in both directions, well above the encoder's resolution");
}

void refuse_if_no_torque(const PreparedMotion& prepared) {
    if (prepared.asked.samples.cwiseAbs().maxCoeff() > 0) return;
    const bool measured = prepared.input == Input::measured;
    throw Refusal(prepared.capture->path + ": the " + prepared.torque_name +
                      " column is zero throughout",
                  measured && !prepared.capture->torque_ref.empty()
                      ? "the measured torque, or use the one that the drive asks for (--input ref)"
                      : "the torque that moved the axis");
}

// Torque and motion through the band limit.
void fill_grid(PreparedMotion& out, Input input) {
    const Capture& capture = *out.capture;
    const TorqueChoice choice = choose_torque(capture, input);
    out.input = choice.input;
    out.motion.torque_measured = choice.input == Input::measured;
    out.torque_name = choice.name;
    out.asked = {on_even_grid(capture, *choice.values), capture.sample_time_s, choice.held,
                 capture.torque_delay_s};
    out.torque = out.band_limit(out.asked);
    if (capture.has_position()) out.position = out.smooth(out.motion.position);
    out.velocity = out.smooth(out.motion.velocity);
    out.acceleration = out.smooth(out.motion.acceleration);
}

} // namespace

TorqueChoice choose_torque(const Capture& capture, Input input) {
    const bool has_ref = !capture.torque_ref.empty(), has_measured = !capture.torque.empty();
    if (input == Input::reference && !has_ref)
        throw Error(ExitCode::bad_file, capture.path + ": no torque reference column, and "
                                                       "--input ref asks for it");
    if (input == Input::measured && !has_measured)
        throw Error(ExitCode::bad_file, capture.path + ": no measured torque column, and "
                                                       "--input measured asks for it");
    if (has_measured && input != Input::reference)
        return {&capture.torque, false, Input::measured, "torque"};
    return {&capture.torque_ref, capture.ref_held, Input::reference, "torque_ref"};
}

Eigen::VectorXd PreparedMotion::smooth(const Eigen::VectorXd& signal, int derivative) const {
    Grid local = grid;
    local.start_s -= motion_start_s;
    return low_pass->apply(signal, local, derivative);
}

Eigen::MatrixXd PreparedMotion::sliding(const Eigen::MatrixXd& columns) const {
    if (!held.size()) return columns;
    return (1 - held.array()).matrix().asDiagonal() * columns;
}

Eigen::MatrixXd PreparedMotion::band_limit(const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd free = sliding(columns);
    Eigen::MatrixXd out(grid.count, columns.cols());
    for (Eigen::Index c = 0; c < columns.cols(); ++c)
        out.col(c) = smooth(free.col(c));
    return out;
}

namespace {

// When the middle of the first sample acts.
double shift_of(const TorqueSignal& signal) {
    return signal.delay_s + (signal.held ? signal.sample_time_s / 2 : 0);
}

} // namespace

Eigen::VectorXd PreparedMotion::sliding(const TorqueSignal& signal) const {
    if (!held.size()) return signal.samples;
    const Vector taken =
        held_weight.at(shift_of(signal), signal.sample_time_s, signal.samples.size());
    return signal.samples.cwiseProduct((1 - taken.array()).matrix());
}

Eigen::VectorXd PreparedMotion::band_limit(const TorqueSignal& signal) const {
    return low_pass->apply(sliding(signal), grid, 0, shift_of(signal));
}

Eigen::Index PreparedMotion::used_count() const {
    return std::count(used.begin(), used.end(), true);
}

Eigen::MatrixXd PreparedMotion::used_rows(const Eigen::MatrixXd& on_grid) const {
    Eigen::MatrixXd out(used_count(), on_grid.cols());
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < on_grid.rows(); ++k)
        if (used[size_t(k)]) out.row(row++) = on_grid.row(k);
    return out;
}

double PreparedMotion::used_power(const Eigen::VectorXd& on_grid) const {
    return used_rows(on_grid).squaredNorm();
}

PreparedMotion prepare_like(const PreparedMotion& like, const Capture& capture) {
    PreparedMotion out = like;
    out.capture = &capture;
    differentiate(capture, out);
    fill_grid(out, like.input);
    out.rests = moving(out);
    out.rests.flip();
    return out;
}

PreparedMotion prepare_motion(const Capture& capture, const MotionOptions& options) {
    PreparedMotion out;
    out.capture = &capture;
    const double top = highest_band(capture.sample_time_s);
    out.period_s = find_period(capture);
    const Band band = options.band_Hz ? Band{*options.band_Hz, BandLimit::asked}
                                      : choose_band(capture, options.input, out.period_s);
    out.band_Hz = band.edge_Hz;
    out.band_limited_by = band.limit;
    if (out.band_Hz > top)
        throw UsageError(fmt::format("--band: {:.4g} Hz is above what {} can show, {:.4g} Hz",
                                     out.band_Hz, capture.path, top));
    differentiate(capture, out);
    out.low_pass.emplace(capture.sample_time_s, out.band_Hz);
    if (out.motion.size() > 0) out.grid = comparison_grid(out, out.band_Hz);
    refuse_if_short(out);

    fill_grid(out, options.input);
    refuse_if_no_torque(out);
    out.used = moving(out);
    const int order = capture.has_position() ? 0 : 1;
    out.velocity_noise = out.position_noise * out.low_pass->noise_gain(1 - order);
    out.acceleration_noise = out.position_noise * out.low_pass->noise_gain(2 - order);
    out.torque_noise = capture.torque_quantum / std::sqrt(12.0) * out.low_pass->noise_gain(0);
    refuse_if_still(out);
    return out;
}

} // namespace servoid
