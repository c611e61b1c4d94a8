// Elastic load: eq. (7), an antiresonance and a resonance between motor torque and motor motion.
#include "effects/effect.hpp"
#include "effects/hiding.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace servoid {
namespace {

// y = s² + 2ζrωr s + ωr² over s² + 2ζaωa s + ωa², times ωa²/ωr², stepped exactly for an input that
// is a straight line between samples.
class InverseModes {
  public:
    InverseModes(const ElasticLoad& load, double step_s) : load_(load) {
        const double wa = load.antiresonance_rad_s, za = load.antiresonance_damping;
        decay_ = std::exp(-za * wa * step_s);
        const double damped = wa * std::sqrt(std::max(1e-12, 1 - za * za));
        cosine_ = std::cos(damped * step_s), sine_ = std::sin(damped * step_s);
        sigma_ = za * wa, damped_ = damped, step_ = step_s;
    }

    // States: p'' + 2ζaωa p' + ωa² p = u.
    double next(double u) {
        const double wa2 = sigma_ * sigma_ + damped_ * damped_;
        // Particular solution of a straight input u0 + r·t: p = α + β t.
        const double rate = (u - input_) / step_;
        const double beta = rate / wa2;
        const double alpha = (input_ - 2 * sigma_ * beta) / wa2;
        const double h = p_ - alpha, hd = dp_ - beta;
        const double k = (hd + sigma_ * h) / damped_;
        const double e = decay_ * (h * cosine_ + k * sine_);
        const double ed =
            decay_ * (-sigma_ * (h * cosine_ + k * sine_) + damped_ * (k * cosine_ - h * sine_));
        p_ = e + alpha + beta * step_;
        dp_ = ed + beta;
        input_ = u;
        return output(u, wa2);
    }

    void start(double u) {
        p_ = u / (sigma_ * sigma_ + damped_ * damped_);
        dp_ = 0;
        input_ = u;
    }

  private:
    double output(double u, double wa2) const {
        const double wr = load_.resonance_rad_s, zr = load_.resonance_damping;
        const double ddp = u - 2 * sigma_ * dp_ - wa2 * p_;
        return wa2 / (wr * wr) * (ddp + 2 * zr * wr * dp_ + wr * wr * p_);
    }

    ElasticLoad load_;
    double decay_, cosine_, sine_, sigma_, damped_, step_;
    double p_ = 0, dp_ = 0, input_ = 0;
};

ElasticLoad load_of(const EffectTerm& term) {
    constexpr double turn = 2 * std::numbers::pi;
    return {turn * term.at("antiresonance_frequency"), turn * term.at("resonance_frequency"),
            term.at("antiresonance_damping"), term.at("resonance_damping")};
}

class ElasticLoadEffect : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "elastic_load",
            .title = "an elastic load",
            .law = "(1/(J s²))·(ωr²/ωa²)·(s²+2ζaωa s+ωa²)/(s²+2ζrωr s+ωr²)",
            .signature = "inertia that seems to grow with frequency, then a resonance",
            .reference = "Andoh 2008, eq. (7)",
            .parameters = {{"antiresonance_frequency", Quantity::frequency, 1e-3, 1e6,
                            "where the load takes all the motor's torque"},
                           {"resonance_frequency", Quantity::frequency, 1e-3, 1e6,
                            "where motor and load swing against each other"},
                           {"antiresonance_damping", Quantity::ratio, 0, 0.999,
                            "damping ratio of the antiresonance"},
                           {"resonance_damping", Quantity::ratio, 0, 0.999,
                            "damping ratio of the resonance"}},
            .replaces = {},
            .needs = {},
            .picture = {.against = Against::in_phase,
                        .move = "multisine:from_Hz=4,to_Hz=140,step_Hz=4,amplitude=0.3,periods=8",
                        .parameters = {{"antiresonance_frequency", 70.0},
                                       {"resonance_frequency", 100.0},
                                       {"antiresonance_damping", 0.15},
                                       {"resonance_damping", 0.15}},
                        .beside = {},
                        .band_Hz = 250}};
        return info;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.elastic = load_of(term);
    }

    int linear_count(const EffectTerm&) const override { return 0; }
    Eigen::MatrixXd columns(const EffectTerm&, const MotionView& motion) const override {
        return Eigen::MatrixXd(motion.size(), 0);
    }

    void shape_inertia(const EffectTerm& term, const MotionView& motion,
                       Eigen::VectorXd& torque) const override {
        if (torque.size() == 0) return;
        InverseModes modes(load_of(term), motion.sample_time_s);
        modes.start(torque[0]);
        for (Eigen::Index i = 0; i < torque.size(); ++i)
            torque[i] = modes.next(torque[i]);
    }

    bool shapes_inertia() const override { return true; }
    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        if (term.at("resonance_frequency") <= term.at("antiresonance_frequency"))
            return "a resonance below its antiresonance is no elastic load";
        return term.at("antiresonance_frequency") > 5 * motion.band_Hz
                   ? "its frequencies lie far above the compared band"
                   : "";
    }

    std::vector<std::string> shape_keys(const EffectTerm&) const override {
        return {"antiresonance_frequency", "resonance_frequency", "antiresonance_damping",
                "resonance_damping"};
    }
    std::vector<EffectTerm> starts(const Search& search) const override {
        std::vector<EffectTerm> out;
        for (double share : {1.6, 1.0, 0.7, 0.5, 0.35, 0.25})
            for (double ratio : {1.12, 1.4, 2.0}) {
                EffectTerm term = blank();
                term.parameters["antiresonance_frequency"] = share * search.motion.band_Hz;
                term.parameters["resonance_frequency"] = ratio * share * search.motion.band_Hz;
                term.parameters["antiresonance_damping"] = 0.05;
                term.parameters["resonance_damping"] = 0.05;
                out.push_back(term);
            }
        return out;
    }

    // Two masses with a spring: the damping of both modes follows from one. Strength: how low the
    // frequencies lie.
    Hiding hide(Draw& draw) const override {
        const double ratio = draw.uniform(1.15, 2.2), damping = draw.log_uniform(0.01, 0.08);
        const double band = draw.scenery().band_Hz;
        return {.at =
                    [=, this](double s) {
                        return with({{"antiresonance_frequency", band / s},
                                     {"resonance_frequency", band * ratio / s},
                                     {"antiresonance_damping", damping},
                                     {"resonance_damping", damping * ratio}});
                    },
                .start = draw.uniform(0.4, 1),
                .least = 0.1,
                .most = 2};
    }
};

} // namespace

const Effect& elastic_load_effect() {
    static const ElasticLoadEffect effect;
    return effect;
}

} // namespace servoid
