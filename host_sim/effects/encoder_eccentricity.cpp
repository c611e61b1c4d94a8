// Encoder eccentricity: the disc sits off its axis and the angle reads wrong once per turn.
#include "effects/hiding.hpp"
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class EncoderEccentricity : public WaveEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "encoder_eccentricity",
            .title = "eccentricity of the encoder",
            .law = "measured θ + e·sin(θ + φ)",
            .signature = "residual once per revolution whose size follows acceleration and squared "
                         "speed, as for a variable inertia but with twice the share of v²",
            .reference = "Hanselman, ISIE 1990; Lara, Xu, Chandra, IEEE TIM 65, 2016",
            .parameters = {{"amplitude", Quantity::position, 0, 0.5, "of the error of the angle"},
                           {"phase", Quantity::angle, -kInf, kInf, "at position zero"}},
            .replaces = {},
            .needs = {},
            .rotary_only = true,
            .picture = {.against = Against::position,
                        .move = "trapezoid:stroke=12.57,velocity=60,acceleration=1000,cycles=3",
                        .parameters = {{"amplitude", 0.05}, {"phase", 0.0}}}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        const double e = term.at("amplitude"), phase = term.at("phase");
        axis.sensor_error = [=](double position) { return e * std::sin(position + phase); };
    }

    double phase_per_position(const EffectTerm&, Motion) const override { return 1; }
    bool depends_on_model(const EffectTerm&) const override { return true; }
    // The true angle is θ − e sin(θ+φ), so v is less by e cos(θ+φ) v and a by
    // e (cos(θ+φ) a − sin(θ+φ) v²): to first order in e.
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        const Eigen::ArrayXd c = motion.position.array().cos(), s = motion.position.array().sin();
        const Eigen::ArrayXd a = motion.acceleration.array(), v = motion.velocity.array();
        const double j = motion.inertia, d = motion.viscous;
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = -(j * (c * a - s * v * v) + d * c * v);
        out.col(1) = j * (s * a + c * v * v) + d * s * v;
        return out;
    }
    std::string cannot_show(const MotionView& motion) const override {
        return motion.travel() > 1.5 ? "" : "the move is less than a quarter of a turn";
    }

    Hiding hide(Draw& draw) const override {
        const double phase = draw.phase();
        return {.at =
                    [=, this](double s) {
                        return with({{"amplitude", s}, {"phase", phase}});
                    },
                .start = 0.01,
                .most = 0.1};
    }
};

} // namespace

const Effect& encoder_eccentricity_effect() {
    static const EncoderEccentricity effect;
    return effect;
}

} // namespace servoid
