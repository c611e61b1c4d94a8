#include "report/signature.hpp"

#include "compare/against.hpp"
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "plant/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kNothing = 0.02; // of the torque's rms: the smallest range of a picture

// The motor of the paper's system 1, with an encoder so fine that only the effect is seen.
Model motor() {
    Model model;
    model.name = "small motor";
    model.inertia = 1.16e-5;
    model.controller = Controller{Controller::Type::p_pi, 40.0, 2.915e-3, 0.0159, 125e-6, 1};
    model.sensor.position_per_count = kTurn / (1 << 22);
    return model;
}

EffectTerm friction(const std::string& name) {
    EffectTerm term;
    term.name = name;
    if (name == "viscous") term.parameters["coefficient"] = 0.75e-4;
    if (name == "coulomb") term.parameters["torque"] = 6.6e-3;
    return term;
}

struct Axis {
    const char *name, *unit;
};

Axis axis_of(Against against) {
    switch (against) {
    case Against::velocity:
        return {"velocity", "rad/s"};
    case Against::position:
        return {"position", "rad"};
    case Against::acceleration:
        return {"acceleration", "rad/s²"};
    case Against::time:
        return {"time", "s"};
    case Against::torque:
        return {"torque", "N·m"};
    case Against::torque_rate:
        return {"change of torque", "N·m/s"};
    case Against::in_phase:
    case Against::quadrature:
        break;
    }
    return {"frequency", "Hz"};
}

void draw_points(Signature& out, Against against, const PreparedMotion& m, const Vector& residual) {
    const Vector x = variable_of(against, m, m.torque);
    for (Eigen::Index k = 1; k + 1 < residual.size(); ++k) {
        if (!m.used[size_t(k)]) continue;
        out.x.push_back(x[k]), out.y.push_back(residual[k]);
    }
}

// Σ over whole periods of x·exp(−jωt), up to a factor that a ratio does not see.
std::complex<double> line_of(const Vector& x, double frequency_Hz, const Grid& grid, double whole) {
    std::complex<double> sum = 0;
    const auto count = Eigen::Index(
        std::floor(double(grid.count) * grid.step_s / whole) * whole / grid.step_s + 0.5);
    for (Eigen::Index k = 0; k < count; ++k)
        sum += std::polar(x[k], -kTurn * frequency_Hz * grid.at(k));
    return sum;
}

// Residual over the torque that the model expects, line by line: the real part looks like more
// inertia, the imaginary part is torque that comes late.
void draw_lines(Signature& out, Against against, const PreparedMotion& m, const Vector& residual) {
    const double period = m.period_s.value_or(1);
    const Vector expected = m.torque - residual;
    const double strongest = std::abs(line_of(expected, 1 / period, m.grid, period));
    for (double f = 1 / period; f < 0.6 * m.band_Hz; f += 1 / period) {
        const std::complex<double> torque = line_of(expected, f, m.grid, period);
        if (std::abs(torque) < 0.01 * strongest) continue;
        const std::complex<double> ratio = line_of(residual, f, m.grid, period) / torque;
        out.x.push_back(f);
        out.y.push_back(100 * (against == Against::in_phase ? ratio.real() : ratio.imag()));
    }
}

} // namespace

Model motor_without(const Effect& effect) {
    Model model = motor();
    for (const std::string& name : effect.info().picture.beside)
        model.effects.push_back(friction(name));
    return model;
}

Model motor_with(const Effect& effect) {
    const EffectInfo& info = effect.info();
    Model model = motor_without(effect);
    std::erase_if(model.effects, [&](const EffectTerm& term) {
        return std::count(info.replaces.begin(), info.replaces.end(), term.name) > 0;
    });
    EffectTerm term;
    term.name = info.name, term.parameters = info.picture.parameters;
    model.effects.push_back(term);
    return model;
}

Signature signature_of(const Effect& effect) {
    const Picture& picture = effect.info().picture;
    const Capture capture = simulate(motor_with(effect), parse_experiment(picture.move), 1);
    MotionOptions options;
    options.band_Hz = picture.band_Hz;
    const std::vector<PreparedMotion> motions = prepare_all({&capture, 1}, options);
    const PreparedMotion& m = motions.front();
    Model without = motor_without(effect);
    if (picture.refitted) without = fit(without, motions).model;
    const Vector residual = residual_torque(without, m);

    Signature out;
    out.x_name = axis_of(picture.against).name, out.x_unit = axis_of(picture.against).unit;
    out.y_name = "residual torque", out.y_unit = "N·m";
    out.smallest_range = kNothing * m.torque.norm() / std::sqrt(double(m.torque.size()));
    const bool lines =
        picture.against == Against::in_phase || picture.against == Against::quadrature;
    if (!lines) {
        draw_points(out, picture.against, m, residual);
        return out;
    }
    out.y_name = picture.against == Against::in_phase
                     ? "residual in phase with the acceleration"
                     : "residual a quarter turn before the acceleration";
    out.y_unit = "% of the model's torque", out.smallest_range = 100 * kNothing;
    draw_lines(out, picture.against, m, residual);
    return out;
}

} // namespace servoid
