// The diagnosis on measured machines, against what is known of them.
#include "diagnose/diagnose.hpp"
#include "real/measured.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

using namespace servoid;

namespace {

bool has(const Refinement& r, const std::string& effect) {
    return std::any_of(r.ladder.begin(), r.ladder.end(),
                       [&](const Rung& rung) { return rung.added == effect; });
}

double value(const FitResult& fit, const std::string& name) {
    for (const FittedParameter& p : fit.parameters)
        if (p.name == name) return p.estimate.value;
    return NAN;
}

} // namespace

TEST(Diagnosis, EmpsFromMassAndOffset) {
    SERVOID_SKIP_WITHOUT(measured::emps_csv());
    const std::vector<Capture> captures = {read_capture(measured::emps_csv())};
    const Model model = measured::emps_model();
    MotionOptions options;
    options.band_Hz = 40;
    const Refinement r = refine(model, prepare_all(captures, options), {});
    for (const Rung& rung : r.ladder)
        std::printf("figure: EMPS, + %s = %.3g %%\n", rung.added.c_str(), 100 * rung.torque_error);
    ASSERT_GE(r.ladder.size(), 5u);
    EXPECT_TRUE((r.ladder[1].added == "coulomb" && r.ladder[2].added == "viscous") ||
                (r.ladder[1].added == "viscous" && r.ladder[2].added == "coulomb"));
    EXPECT_EQ(r.ladder[3].added, "viscous_asymmetric");
    EXPECT_FALSE(has(r, "stribeck")) << "its coefficient is negative at every width";
    EXPECT_FALSE(has(r, "dead_time")) << "the hold is all the delay there is";
    const double period_mm = 1000 / value(r.result, "cogging.order");
    std::printf("figure: EMPS, period of the ripple = %.4f mm (asked: 2.5 within 1 %%)\n",
                period_mm);
    EXPECT_NEAR(period_mm, 2.5, 0.025);
    EXPECT_LE(r.result.torque_error, 0.026);
}

TEST(Diagnosis, MotorBenchIsAnElasticLoadBehindADeadTime) {
    const std::string file = measured::data_folder() + "/motor_bench/motor_bench.csv";
    SERVOID_SKIP_WITHOUT(file);
    const std::vector<Capture> captures = {read_capture(file)};
    const Model model = parse_model("motion = \"rotary\"\n[plant]\ninertia = 0.02\n"
                                    "[effects.viscous]\ncoefficient = 0.01\n",
                                    "bench");
    const Refinement r = refine(model, prepare_all(captures, {}), {});
    ASSERT_GE(r.ladder.size(), 3u);
    EXPECT_EQ(r.ladder[1].added, "elastic_load");
    EXPECT_TRUE(has(r, "dead_time") || has(r, "torque_lag"));
    const double wa = value(r.result, "elastic_load.antiresonance_frequency");
    const double wr = value(r.result, "elastic_load.resonance_frequency");
    const double delay = value(r.result, "dead_time.delay");
    std::printf("figure: motor bench, antiresonance and resonance = %.2f, %.2f Hz (asked: 54.0, "
                "76.3 within 1 %%)\n",
                wa, wr);
    std::printf("figure: motor bench, dead time = %.3f ms (asked: 0.10 ± 0.05)\n", 1e3 * delay);
    EXPECT_NEAR(wa, 54.0, 0.54);
    EXPECT_NEAR(wr, 76.3, 0.763);
    EXPECT_NEAR(delay, 1e-4, 5e-5);
}
