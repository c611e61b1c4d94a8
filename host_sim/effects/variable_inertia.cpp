// Variable inertia: a crank, an eccentric, a linkage.
#include "effects/wave.hpp"
#include "plant/axis.hpp"

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class VariableInertia : public WaveEffect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "variable_inertia",
            .law = "J·(1 + a·cos(nθ + φ))·v' + ½·J'·v²",
            .signature =
                "residual a sine of position whose size follows acceleration and squared speed",
            .reference = "Goldstein, Classical Mechanics; Kakizaki, Otani, Kogure 2002",
            .parameters = {{"fraction", Quantity::ratio, 0, 0.95, "of the inertia"},
                           {"order", Quantity::per_rev, 1e-9, kInf,
                            "cycles per revolution or per metre"},
                           {"phase", Quantity::angle, -kInf, kInf, "at position zero"}},
            .replaces = {},
            .needs = {}};
        return info;
    }

    const char* amplitude_key() const override { return "fraction"; }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.inertia_wave = InertiaWave{term.at("fraction"),
                                        wave_number(term.at("order"), axis.kind), term.at("phase")};
    }

    bool depends_on_model() const override { return true; }
    // J a cos(x+φ) − ½ J κ sin(x+φ) v², x = κθ, split into cos φ and sin φ.
    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0) return Eigen::MatrixXd::Zero(motion.size(), 2);
        const double k = wave_number(term.at("order"), motion.kind);
        const Eigen::ArrayXd c = (k * motion.position.array()).cos();
        const Eigen::ArrayXd s = (k * motion.position.array()).sin();
        const Eigen::ArrayXd a = motion.acceleration.array();
        const Eigen::ArrayXd v2 = motion.velocity.array().square() * (k / 2);
        Eigen::MatrixXd out(motion.size(), 2);
        out.col(0) = motion.inertia * (c * a - s * v2);
        out.col(1) = -motion.inertia * (s * a + c * v2);
        return out;
    }

    std::string implausible(const EffectTerm& term, const MotionView& motion) const override {
        const double cycles = wave_number(term.at("order"), motion.kind) * motion.travel() / kTurn;
        return cycles < kFewestCycles ? "the travel holds less than one and a half cycles" : "";
    }

    std::vector<std::string> shape_keys() const override { return {"order"}; }
    double search_price() const override { return 5; }
    std::vector<EffectTerm> starts(const Search& search) const override {
        // exp(iκθ)·(a + iκ v²/2): its real part is the first column, its imaginary part minus the
        // second.
        const std::complex<double> half_i(0, 0.5);
        const OrderScan scan{search, search.acceleration.cast<std::complex<double>>(),
                             half_i * search.velocity.cwiseAbs2().cast<std::complex<double>>()};
        std::vector<EffectTerm> out;
        for (double k : strongest_orders(scan, 3)) {
            EffectTerm term = blank();
            term.parameters["order"] = order_of(k, search.motion.kind);
            out.push_back(term);
        }
        return out;
    }
};

} // namespace

const Effect& variable_inertia_effect() {
    static const VariableInertia effect;
    return effect;
}

} // namespace servoid
