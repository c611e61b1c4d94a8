#include "compare/loop_twin.hpp"

#include "plant/drive.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Values = std::vector<double>;

constexpr int kMostPeriods = 100; // to a row: beyond, a reference that runs straight is none

// Straight line through the first positions: the velocity the record starts with.
double first_velocity(const Capture& capture) {
    const size_t n = std::min<size_t>(8, capture.rows());
    double st = 0, sp = 0, stt = 0, stp = 0;
    for (size_t i = 0; i < n; ++i) {
        const double t = double(i) * capture.sample_time_s, p = capture.position[i];
        st += t, sp += p, stt += t * t, stp += t * p;
    }
    const double m = double(n);
    return (stp - st * sp / m) / (stt - st * st / m);
}

// Control periods to a row, where the loop can be simulated: one, or several of which every last
// one was recorded.
std::optional<int> periods_per_row(const Model& model, const Capture& capture) {
    if (!model.controller || capture.position_ref.empty() || !capture.has_position()) return {};
    if (!capture.uniform || capture.torque_in_ampere || capture.rows() < 8) return {};
    const double ratio = capture.sample_time_s / model.controller->sample_time_s;
    const double whole = std::round(ratio);
    if (whole < 1 || whole > kMostPeriods || std::abs(ratio - whole) > 0.01) return {};
    return int(whole);
}

// The loop along the recorded reference, a row at a time. Between two rows the reference runs
// straight.
class Rider {
  public:
    Rider(SimulatedDrive& drive, const Values& reference, int periods)
        : drive_(drive), reference_(reference), periods_(periods) {}

    DriveSample row(size_t i) {
        const double from = reference_[i], to = reference_[std::min(i + 1, reference_.size() - 1)];
        const DriveSample first = drive_.step(from);
        for (int k = 1; k < periods_; ++k)
            drive_.step(from + (to - from) * k / periods_);
        return first;
    }

  private:
    SimulatedDrive& drive_;
    const Values& reference_;
    int periods_;
};

const Values& torque_of(const Capture& capture) {
    return capture.torque_ref.empty() ? capture.torque : capture.torque_ref;
}

// Rows to a period, where the motion at the record's start is already the one that repeats.
size_t rows_before(const Capture& capture) {
    if (!capture.period_s) return 0;
    const auto period = size_t(std::lround(*capture.period_s / capture.sample_time_s));
    if (period < 16 || capture.rows() < 2 * period) return 0;
    const auto differs = [&](size_t from, size_t to) {
        double sum = 0;
        for (size_t i = from; i < to; ++i)
            sum += std::abs(capture.position[i + period] - capture.position[i]);
        return sum / double(to - from);
    };
    const double start = differs(0, period / 8), end = differs(period - period / 8, period);
    return start <= 3 * end + capture.position_quantum ? period : 0;
}

double counted(double value, double quantum) {
    return quantum > 0 ? std::round(value / quantum) * quantum : value;
}

// Laws of time count from the record's first row, which comes this long after the start.
AxisDescription started_before(AxisDescription axis, double time_s) {
    for (auto& law : axis.opposing)
        law = [law, time_s](AxisPoint p) {
            p.time_s -= time_s;
            return law(p);
        };
    if (axis.friction_factor)
        axis.friction_factor = [law = axis.friction_factor, time_s](double t) {
            return law(std::max(0.0, t - time_s));
        };
    return axis;
}

Model with_encoder(Model model, const Capture& capture) {
    if (!(model.sensor.position_per_count > 0))
        model.sensor.position_per_count = capture.position_quantum;
    return model;
}

} // namespace

std::optional<Capture> loop_twin(const Model& model, const Capture& capture,
                                 const TwinNoise& noise) {
    const std::optional<int> periods = periods_per_row(model, capture);
    if (!periods) return std::nullopt;
    const Values& torque = torque_of(capture);
    DriveOptions options;
    options.seed = noise.seed, options.torque_noise = noise.torque;
    for (double t : torque)
        options.full_torque = std::max(options.full_torque, std::abs(t) / 4);
    const size_t before = rows_before(capture);
    AxisDescription axis = axis_of(model);
    if (before > 0) axis = started_before(axis, double(before) * capture.sample_time_s);
    SimulatedDrive drive(with_encoder(model, capture), options, axis);
    drive.set_state(capture.position.front(), first_velocity(capture));
    drive.set_first_torque(capture.position_ref.front(), torque.front());
    Rider rider(drive, capture.position_ref, *periods);
    for (size_t i = 0; i < before; ++i)
        rider.row(i);
    Capture out = capture;
    out.path = capture.path + " (simulated)";
    out.velocity.clear(), out.load_position.clear();
    Values& answer = capture.torque_ref.empty() ? out.torque : out.torque_ref;
    for (size_t i = 0; i < capture.rows(); ++i) {
        const DriveSample s = rider.row(i);
        answer[i] = counted(s.torque, capture.torque_quantum);
        out.position[i] = s.position;
    }
    return out;
}

} // namespace servoid
