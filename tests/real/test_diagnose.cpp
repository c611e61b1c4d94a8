// The diagnosis on measured machines, against what is known of them.
#include "diagnose/diagnose.hpp"
#include "real/measured.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <numbers>

using namespace servoid;

namespace {

bool has(const Refinement& r, const std::string& effect) {
    return std::any_of(r.ladder.begin(), r.ladder.end(),
                       [&](const Rung& rung) { return rung.added == effect; });
}

std::vector<std::string> cogging_orders(const FitResult& fit) {
    std::vector<std::string> out;
    for (const FittedParameter& p : fit.parameters)
        if (p.name.starts_with("cogging") && p.name.ends_with(".order"))
            out.push_back(std::to_string(std::lround(p.estimate.value)));
    return out;
}

double mean(const std::vector<double>& x) {
    double sum = 0;
    for (double v : x)
        sum += v;
    return sum / double(x.size());
}

// ‖T − T̂‖/‖T‖ over the means of constant-speed runs.
double error_of_run_means(const std::vector<Capture>& runs, const Model& m) {
    const auto at = [&](const char* effect, const char* key) {
        const EffectTerm* term = m.find(effect);
        return term ? term->at(key) : 0.0;
    };
    double miss = 0, all = 0;
    for (const Capture& run : runs) {
        const double v = mean(run.velocity), t = mean(run.torque), vs = at("stribeck", "velocity");
        const double extra =
            vs > 0 ? at("stribeck", "extra_torque") * std::exp(-v * v / (vs * vs)) : 0;
        const double model = at("viscous", "coefficient") * v + at("constant_torque", "torque") +
                             std::copysign(at("coulomb", "torque") + extra, v);
        miss += (t - model) * (t - model), all += t * t;
    }
    return std::sqrt(miss / all);
}

// The fundamental of the last whole periods on line k of a signal on the grid.
std::complex<double> line(const Eigen::VectorXd& x, Eigen::Index points, int k) {
    const Eigen::Index first = x.size() - (x.size() / points - 1) * points;
    std::complex<double> sum = 0;
    for (Eigen::Index i = first; i < x.size(); ++i)
        sum += x[i] * std::polar(1.0, -2 * std::numbers::pi * k * double(i) / double(points));
    return sum / double(x.size() - first);
}

// ‖G − Ĝ‖/‖G‖ over the excited lines, G = velocity / torque: Ĝ/G − 1 is the residual over the
// torque, to first order.
double frf_error(const Model& model, const PreparedMotion& m, int from_Hz, int to_Hz, int step_Hz) {
    const Eigen::VectorXd residual = residual_torque(model, m);
    const auto points = Eigen::Index(std::lround(*m.period_s / m.grid.step_s));
    double miss = 0, all = 0;
    for (int k = from_Hz; k <= to_Hz; k += step_Hz) {
        const auto torque = line(m.torque, points, k);
        const double g = std::norm(line(m.velocity, points, k) / torque);
        miss += g * std::norm(line(residual, points, k) / torque), all += g;
    }
    return std::sqrt(miss / all);
}

Capture rows_of(Capture c, size_t from, size_t to) {
    for (auto* v : {&c.time_s, &c.torque_ref, &c.position, &c.position_ref})
        *v = std::vector<double>(v->begin() + long(from), v->begin() + long(to));
    for (double& t : c.time_s)
        t -= double(from) * c.sample_time_s;
    return c;
}

// By an encoder whose zero lies at `zero`.
Capture read_from(Capture c, double zero) {
    for (auto* v : {&c.position, &c.position_ref})
        for (double& p : *v)
            p -= zero;
    return c;
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

// Three periods are fitted, the rest is validated: once as it is, once read from another zero.
TEST(Diagnosis, EmpsValidatesOnARecordingThatWasNotHomed) {
    SERVOID_SKIP_WITHOUT(measured::emps_csv());
    const Capture all = read_capture(measured::emps_csv());
    constexpr size_t kThreePeriods = 3 * 6240;
    const double zero_m = 0.8e-3; // of a ripple every 2.5 mm
    const std::vector<Capture> captures = {
        rows_of(all, 0, kThreePeriods), rows_of(all, kThreePeriods, all.rows()),
        read_from(rows_of(all, kThreePeriods, all.rows()), zero_m)};
    MotionOptions options;
    options.band_Hz = 40;
    const auto m = prepare_all(captures, options);
    const Refinement homed = refine(measured::emps_model(), {m[0]}, {m[1]});
    const Refinement away = refine(measured::emps_model(), {m[0]}, {m[2]});
    EXPECT_TRUE(homed.validation_homing.all_moved().empty());
    ASSERT_TRUE(has(homed, "cogging"));
    ASSERT_TRUE(has(away, "cogging"));
    ASSERT_TRUE(away.validation_homing.moved(0));
    const Estimate zero = away.validation_homing.offset[0];
    const double homed_error = homed.ladder.back().validation_error;
    const double away_error = away.ladder.back().validation_error;
    std::printf("figure: EMPS, validated error %.3g %%, read from another zero %.3g %%, which is "
                "found at %.4f +- %.4f mm (0.8)\n",
                100 * homed_error, 100 * away_error, 1e3 * zero.value, 1e3 * zero.std);
    EXPECT_NEAR(away_error, homed_error, 0.02 * homed_error);
    const double off = std::remainder(zero.value - zero_m, 1 / value(away.result, "cogging.order"));
    EXPECT_LT(std::abs(off), 3 * zero.std);
    // Fitted together, the zero is found too, and changes nothing else.
    const Diagnosis d = diagnose(away.result.model, {m[0], m[2]});
    ASSERT_TRUE(d.before.homing.moved(1));
    const Diagnosis same = diagnose(away.result.model, {m[0], m[1]});
    EXPECT_TRUE(same.before.homing.all_moved().empty());
    EXPECT_NEAR(d.error_before, same.error_before, 0.02 * same.error_before);
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
    const double frf = frf_error(r.result.model, prepare_all(captures, {}).front(), 13, 249, 4);
    std::printf("figure: motor bench, error of the frequency response = %.3g %% (asked: 4 %%)\n",
                100 * frf);
    EXPECT_LT(frf, 0.04);
    std::printf(
        "figure: motor bench, motor's share of the inertia = %.4f (asked: 0.5 within 3 %%)\n",
        std::pow(wa / wr, 2));
    EXPECT_NEAR(std::pow(wa / wr, 2), 0.5, 0.015);
    EXPECT_NEAR(wa, 54.0, 0.54);
    EXPECT_NEAR(wr, 76.3, 0.763);
    EXPECT_NEAR(delay, 1e-4, 5e-5);
}

TEST(Diagnosis, EposIsCoulombAndThenStribeck) {
    const std::string folder = measured::data_folder() + "/epos_drive1";
    SERVOID_SKIP_WITHOUT(folder);
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("steady")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Capture> runs;
    for (const std::string& file : files)
        runs.push_back(read_capture(file));
    const auto motions = prepare_all(runs, {});
    Model model = parse_model("motion = \"rotary\"\n[plant]\ninertia = 2.5e-6\n"
                              "[effects.viscous]\ncoefficient = 2e-5\n"
                              "[effects.constant_torque]\ntorque = 0.0\n",
                              "epos");
    const char* expected[] = {"coulomb", "stribeck"};
    std::printf("figure: EPOS, run means, viscous and constant torque = %.3g %%\n",
                100 * error_of_run_means(runs, fit(model, motions).model));
    for (const char* effect : expected) {
        const Diagnosis d = diagnose(model, motions);
        ASSERT_EQ(d.candidates.front().effect, effect);
        model = d.candidates.front().fit.model;
        std::printf("figure: EPOS, run means, + %s = %.3g %%\n", effect,
                    100 * error_of_run_means(runs, model));
    }
    EXPECT_LT(error_of_run_means(runs, model), 0.035);
}

TEST(Diagnosis, OdriveIsCoggingOfOrder7AndItsRelatives) {
    const std::string file = measured::data_folder() + "/odrive_slow/odrive_slow.csv";
    SERVOID_SKIP_WITHOUT(file);
    const std::vector<Capture> captures = {read_capture(file)};
    const Model model = parse_model("motion = \"rotary\"\n[plant]\ninertia = 2.5e-4\n"
                                    "[effects.constant_torque]\ntorque = 0.2\n",
                                    "odrive");
    const Refinement r = refine(model, prepare_all(captures, {}), {});
    ASSERT_GE(r.ladder.size(), 4u);
    EXPECT_EQ(r.ladder[1].added, "cogging");
    const std::vector<std::string> orders = cogging_orders(r.result);
    ASSERT_FALSE(orders.empty());
    EXPECT_EQ(orders[0], "7");
    std::string text;
    for (const std::string& order : orders)
        text += (text.empty() ? "" : ", ") + order;
    std::printf("figure: ODrive, orders = %s (asked: 7, then 28, 14, 12)\n", text.c_str());
    for (const char* order : {"28", "14", "12"})
        EXPECT_NE(std::find(orders.begin(), orders.end(), order), orders.end()) << order;
}
