// Coulomb friction leaks into J where the motion is no sine: bang-bang acceleration puts the torque
// of friction in phase with the position. A model that knows the friction takes it out again.
#include "identify/identify.hpp"
#include "paper/paper.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::paper;

namespace {

// A 95 kg axis with 20 N of Coulomb friction that follows its reference closely.
Model heavy_axis() {
    return parse_model(R"(name = "heavy"
motion = "linear"
[plant]
inertia = 95
[controller]
type = "p_p"
position_gain = 160.0
speed_gain = 8557.0
sample_time = 1e-3
[sensor]
metres_per_count = 5e-8
[effects.viscous]
coefficient = 203
[effects.coulomb]
torque = 20.4
)",
                       "heavy axis");
}

struct Move {
    double distance_m, duration_s;
};

// Half a move at full acceleration, half at full braking.
double bang_bang_at(double tau) {
    return tau < 0.5 ? 2 * tau * tau : 1 - 2 * (1 - tau) * (1 - tau);
}

// Out in a slow and a fast move, back in one: with a single move each way the sign of the speed is
// in quadrature with the position, and nothing leaks.
double position_in_cycle(double t) {
    const Move moves[] = {{0.05, 2}, {0.2, 1}, {-0.25, 1.5}};
    double start = 0;
    for (const Move& move : moves) {
        if (t < move.duration_s) return start + move.distance_m * bang_bang_at(t / move.duration_s);
        start += move.distance_m, t -= move.duration_s;
    }
    return start;
}

Capture bang_bang(const Model& model) {
    Experiment e;
    e.period_s = 4.5, e.duration_s = 4 * 4.5;
    e.position_ref = [](double t) { return position_in_cycle(std::fmod(t, 4.5)); };
    return simulate(model, e, 1);
}

// Over whole periods of a move that has settled the plain DFT is exact. The trend-free bin is not
// meant for such a move: its trend takes part of the harmonics.
Identification identified(const Capture& capture, const Model* model,
                          sid_bin_method_t method = SID_BIN_PLAIN_DFT) {
    IdentifyOptions options;
    options.model = model;
    options.method = method;
    return identify(capture, options).front();
}

TEST(CoulombLeak, TheFundamentalAloneOverestimates) {
    const Model model = heavy_axis();
    const Capture capture = bang_bang(model);
    const double plain = identified(capture, nullptr).inertia.value / model.inertia - 1;
    figure("bang-bang move, J of the fundamental alone", 100 * plain, "% too high", "above +10");
    EXPECT_GT(plain, 0.1);
}

TEST(CoulombLeak, TheModelsFrictionTakesItOut) {
    const Model model = heavy_axis();
    const Identification out = identified(bang_bang(model), &model);
    const double error = out.inertia.value / model.inertia - 1;
    figure("bang-bang move, J with the model's Coulomb friction out", 100 * error, "%",
           "within ±2");
    figure("  the leak that was predicted", out.coulomb_leak, "kg", "as much as was too high");
    EXPECT_LE(std::abs(error), 0.02);
    EXPECT_GT(out.coulomb_leak, 0);
}

// Without friction in the axis there is nothing to leak: the method itself is not what is wrong.
TEST(CoulombLeak, NoneWithoutFriction) {
    const Model model = without(heavy_axis(), "coulomb");
    const double error = identified(bang_bang(model), nullptr).inertia.value / model.inertia - 1;
    figure("bang-bang move without Coulomb friction, J of the fundamental", 100 * error, "%",
           "within ±1");
    EXPECT_LE(std::abs(error), 0.01);
    const double cubic =
        identified(bang_bang(model), nullptr, SID_BIN_CUBIC).inertia.value / model.inertia - 1;
    figure("  the same by the trend-free bin", 100 * cubic, "%", "shown only");
}

} // namespace
