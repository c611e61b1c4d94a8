// Periodic disturbance: a fan, a pump, another axis; tied to time and not to the motion.
#include "compare/spectrum.hpp"
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

constexpr double kTiedToMotion = 30; // an alias: only another speed tells

class PeriodicDisturbance : public WaveEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "periodic_disturbance",
            .title = "a periodic disturbance",
            .law = "A·sin(2πft + φ)",
            .signature = "residual a sine of time, the same whatever the axis does",
            .reference = "Bodson, Sacks, Khosla, IEEE TAC 39, 1994",
            .parameters = {{"amplitude", Quantity::torque, 0, kInf, "of the sine"},
                           {"frequency", Quantity::frequency, 1e-6, kInf, "of the sine"},
                           {"phase", Quantity::angle, -kInf, kInf, "at the first row"}},
            .replaces = {},
            .needs = {},
            .repeatable = true,
            .picture = {.against = Against::time,
                        .move = "trapezoid:velocity=60,acceleration=2500,cycles=3",
                        .parameters = {{"amplitude", 5e-3}, {"frequency", 11.0}, {"phase", 0.0}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double a = term.at("amplitude"), phase = term.at("phase");
        const double w = kTurn * term.at("frequency");
        axis.opposing.push_back(
            [=](const AxisPoint& p) { return a * std::sin(w * p.time_s + phase); });
    }

    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        const double w = kTurn * term.at("frequency");
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = (w * motion.time_s.array()).sin();
        out.col(1) = (w * motion.time_s.array()).cos();
        return out;
    }

    // On one-way motion a line of time at a whole order of the turning is the turning's.
    double evidence(const Estimates& estimates, const MotionView& m) const override {
        if (m.kind != Motion::rotary || m.position.size() == 0) return 0;
        const double travelled = std::abs(m.position[m.size() - 1] - m.position[0]);
        if (travelled < 0.95 * m.travel()) return 0;
        const double turns_Hz = travelled / (m.sample_time_s * double(m.size() - 1)) / kTurn;
        const Estimate& frequency = estimates.at("frequency");
        const double order = frequency.value / turns_Hz;
        const double within = std::max(0.1, 3 * frequency.std / turns_Hz);
        return std::abs(order - std::round(order)) < within ? -kTiedToMotion : 0;
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        const double cycles = term.at("frequency") * motion.sample_time_s * double(motion.size());
        return cycles < 2.5 ? "the record holds too few of its cycles: as well a slow drift" : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override { return {"frequency"}; }
    double search_price() const override { return 5; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        const double length = search.time_s[search.time_s.size() - 1] - search.time_s[0];
        const Eigen::Index n = search.time_s.size();
        const double step = (search.time_s.tail(n - 1) - search.time_s.head(n - 1)).minCoeff();
        // Points where the axis rests are missing: nothing in their place keeps the phase.
        Eigen::VectorXd residual = Eigen::VectorXd::Zero(Eigen::Index(length / step + 1.5));
        for (Eigen::Index i = 0; i < n; ++i)
            residual[Eigen::Index((search.time_s[i] - search.time_s[0]) / step + 0.5)] =
                search.residual[i];
        for (double f : strongest_lines_Hz(residual, step, 3)) {
            if (f * length < kFewestCycles) continue;
            EffectTerm term = blank();
            term.parameters["frequency"] = f;
            out.push_back(term);
        }
        return out;
    }

    // Between the harmonics of a move that repeats: on one, another law would do as well.
    Hiding hide(Draw& draw) const override {
        const Scenery& s = draw.scenery();
        const double phase = draw.phase(), slowest = 4 / s.duration_s;
        if (!(0.7 * s.band_Hz > slowest)) return {};
        double f = draw.log_uniform(slowest, 0.7 * s.band_Hz);
        if (s.period_s > 0) f = (std::floor(f * s.period_s) + draw.uniform(0.3, 0.7)) / s.period_s;
        return {.at =
                    [=, this](double a) {
                        return with({{"amplitude", a}, {"frequency", f}, {"phase", phase}});
                    },
                .start = draw.torque()};
    }
};

} // namespace

const Effect& periodic_disturbance_effect() {
    static const PeriodicDisturbance effect;
    return effect;
}

} // namespace servoid
