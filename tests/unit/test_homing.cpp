// Captures of an axis whose encoder was not homed between them: their position zeros differ.
#include "compare/compare.hpp"
#include "compare/homing_search.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"
#include "effects/wave.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace servoid;

namespace {

Model motor(const std::string& more = "") {
    return parse_model("motion = \"rotary\"\n[plant]\ninertia = 5.56e-5\n"
                       "[controller]\ntype = \"p_pi\"\nposition_gain = 40.0\nspeed_gain = 7e-3\n"
                       "integral_time = 0.016\nsample_time = 125e-6\n"
                       "[sensor]\ncounts_per_rev = 131072\n[drive]\nrated_torque = 0.637\n"
                       "[effects.viscous]\ncoefficient = 9.6e-4\n[effects.coulomb]\n"
                       "torque = 2.1e-2\n" +
                           more,
                       "motor");
}

constexpr const char* kCogging =
    "[[effects.cogging]]\namplitude = 8e-3\norder = 6.0\nphase = 0.7\n";
constexpr const char* kRipple =
    "[[effects.torque_ripple]]\nfraction = 0.12\norder = 8.0\nphase = -1.0\n";
constexpr const char* kGravity = "[effects.gravity]\ntorque = 2e-2\nphase = 0.4\n";
constexpr const char* kVariable =
    "[effects.variable_inertia]\nfraction = 0.2\norder = 2.0\nphase = 0.5\n";
constexpr const char* kEccentric =
    "[effects.encoder_eccentricity]\namplitude = 0.05\nphase = 0.9\n";

// Recorded by an encoder whose zero is `zero` on the axis' own scale.
Capture read_from(Capture capture, double zero) {
    for (std::vector<double>* column : {&capture.position, &capture.position_ref})
        for (double& p : *column)
            p -= zero;
    return capture;
}

std::string move(double start, double speed = 40) {
    return "trapezoid:stroke=9,velocity=" + std::to_string(speed) +
           ",acceleration=1500,cycles=3,torque_noise=1e-3,start=" + std::to_string(start);
}

// Captures of one axis, each with a move, a place and a zero of its own.
std::vector<Capture> captures_of(const Model& truth, const std::vector<double>& zeros) {
    std::vector<Capture> out;
    for (size_t i = 0; i < zeros.size(); ++i) {
        const Capture c = simulate(
            truth, parse_experiment(move(0.8 * double(i), 40 - 8 * double(i))), 3 + unsigned(i));
        out.push_back(read_from(c, zeros[i]));
    }
    return out;
}

// a − b, modulo a period of the wave.
double apart(double a, double b, double period) { return std::remainder(a - b, period); }

double parameter_of(const Candidate& c, const std::string& name, double* std = nullptr) {
    for (const FittedParameter& p : c.parameters)
        if (p.name == name) {
            if (std) *std = p.estimate.std;
            return p.estimate.value;
        }
    return NAN;
}

struct Hidden {
    const char *effect, *size, *table;
    double value, period;
};

void expect_found(const Hidden& h, const std::vector<double>& zeros) {
    const std::vector<Capture> captures = captures_of(motor(h.table), zeros);
    const Diagnosis d = diagnose(motor(), prepare_all(captures, {}));
    ASSERT_FALSE(d.candidates.empty());
    const Candidate& best = d.candidates.front();
    EXPECT_EQ(d.verdict, Verdict::missing) << h.effect << ": " << d.advice;
    ASSERT_EQ(best.effect, h.effect);
    double std = 0;
    const double size = parameter_of(best, h.size, &std);
    std::printf("figure: %s in %zu captures, error %.3g %% -> %.3g %%, %s = %.4g +- %.2g (%.4g)\n",
                h.effect, zeros.size(), 100 * d.error_before, 100 * best.error_after, h.size, size,
                std, h.value);
    EXPECT_NEAR(size, h.value, std::max(3 * std, 0.02 * h.value));
    for (size_t i = 1; i < zeros.size(); ++i) {
        ASSERT_TRUE(best.fit.homing.moved(i));
        const Estimate& offset = best.fit.homing.offset[i];
        const double off = apart(offset.value, zeros[i] - zeros[0], h.period);
        std::printf("figure: %s, zero of capture %zu = %.5f +- %.5f rad, off by %.5f\n", h.effect,
                    i, offset.value, offset.std, off);
        EXPECT_GT(offset.std, 0);
        EXPECT_LT(std::abs(off), 3 * offset.std);
        EXPECT_LT(offset.std, 0.02 * h.period);
    }
}

FitResult fitted_at(const Model& model, const std::vector<Capture>& captures) {
    const std::vector<PreparedMotion> motions = prepare_all(captures, {});
    Assembler assembler(motions);
    return fit_homed(model, assembler);
}

} // namespace

TEST(Homing, EveryWaveOfThePositionTurnsItsColumnsAsItsLawDoes) {
    for (const char* table : {kCogging, kRipple, kGravity, kVariable, kEccentric}) {
        const Model model = motor(table);
        const std::vector<Capture> here = captures_of(model, {0}),
                                   there = {read_from(here.front(), 0.37)};
        const auto at_home = prepare_all(here, {}), away = prepare_all(there, {});
        Assembler a(at_home), b(away);
        a.set_context(model);
        b.set_homing({{{0.37, 0}}});
        b.set_context(model);
        const Eigen::MatrixXd difference = a.assemble(model).columns - b.assemble(model).columns;
        EXPECT_LT(difference.norm(), 1e-6 * a.assemble(model).columns.norm()) << table;
        const Eigen::VectorXd torque = model_torque(model, at_home.front()),
                              moved = model_torque(at_zero(model, 0.37), away.front());
        EXPECT_LT((torque - moved).norm(), 1e-6 * torque.norm()) << table;
    }
}

TEST(Homing, ItsSlopeIsTheDifference) {
    const Model model = motor(std::string(kCogging) + kGravity);
    const std::vector<Capture> captures = captures_of(model, {0, 0.3});
    const auto motions = prepare_all(captures, {});
    Assembler assembler(motions);
    assembler.set_context(model);
    const auto torque_at = [&](double offset) {
        assembler.set_homing({{{}, {offset, 0}}});
        return Eigen::VectorXd(assembler.assemble(model).columns * coefficient_values(model));
    };
    const Eigen::VectorXd difference = (torque_at(0.3 + 1e-5) - torque_at(0.3 - 1e-5)) / 2e-5;
    assembler.set_homing({{{}, {0.3, 0}}});
    const Eigen::MatrixXd columns = assembler.assemble(model).columns;
    const Rows rows = assembler.rows_of(1);
    const Eigen::VectorXd slope = offset_slope(columns.middleRows(rows.first, rows.count),
                                               waves_of(model), coefficient_values(model));
    EXPECT_LT((difference.segment(rows.first, rows.count) - slope).norm(), 1e-6 * slope.norm());
    EXPECT_EQ(difference.head(rows.first).norm(), 0);
}

TEST(Homing, DiagnoseFindsCoggingInCapturesThatWereNotHomed) {
    expect_found({"cogging", "amplitude", kCogging, 8e-3, kTurn / 6}, {0, 0.31});
    expect_found({"cogging", "amplitude", kCogging, 8e-3, kTurn / 6}, {0.2, -12.9, 1.234});
}

TEST(Homing, DiagnoseFindsRippleInCapturesThatWereNotHomed) {
    expect_found({"torque_ripple", "fraction", kRipple, 0.12, kTurn / 8}, {0, 2.6, 0.4});
}

TEST(Homing, DiagnoseFindsGravityInCapturesThatWereNotHomed) {
    expect_found({"gravity", "torque", kGravity, 2e-2, kTurn}, {0, 2.2});
}

// A short fast capture knows an order to within a few cycles of the long one: the search looks at
// both.
TEST(Homing, AShortCaptureDoesNotDecideTheOrderForALongOne) {
    const struct {
        double order, short_stroke, long_stroke;
    } cases[] = {{9.04, 3.3, 45}, {8.88, 3.7, 45}, {8.4, 3.7, 70}};
    for (const auto& c : cases) {
        const Model truth =
            motor("[[effects.torque_ripple]]\nfraction = 0.1\nphase = 1.0\norder = " +
                  std::to_string(c.order) + "\n");
        const auto run = [&](const std::string& text) {
            return simulate(truth, parse_experiment("trapezoid:torque_noise=2e-3," + text), 3);
        };
        const std::vector<Capture> captures = {
            run("velocity=30,acceleration=2000,cycles=8,stroke=" + std::to_string(c.short_stroke)),
            read_from(run("velocity=12,acceleration=300,cycles=1,start=3,stroke=" +
                          std::to_string(c.long_stroke)),
                      -17.3)};
        const auto motions = prepare_all(captures, {});
        Assembler assembler(motions);
        const FitResult before = fit_homed(motor(), assembler);
        const FitResult after = fit_with(before, *find_effect("torque_ripple"), assembler);
        EXPECT_NEAR(after.model.effects.back().at("order"), c.order, 2e-3);
    }
}

// While friction is missing, an order may move until two captures' waves meet without an offset;
// and an order that was guessed from one capture may ask for an offset that a better order does
// not.
TEST(Homing, IsJudgedWithTheOrderFree) {
    const auto variable = [](double fraction, double order, double phase) {
        return "[effects.variable_inertia]\nfraction = " + std::to_string(fraction) +
               "\norder = " + std::to_string(order) + "\nphase = " + std::to_string(phase) + "\n";
    };
    const auto run = [](const Model& truth, const std::string& text, unsigned seed) {
        return simulate(truth, parse_experiment("trapezoid:cycles=2,torque_noise=2e-3," + text),
                        seed);
    };
    const std::string weak = variable(0.065046, 2.75, -0.894611);
    const std::vector<Capture> away = {
        run(motor(weak), "stroke=14.312,velocity=14.952,acceleration=1489.3,start=2.794", 10),
        read_from(
            run(motor(weak), "stroke=18.038,velocity=20.243,acceleration=1186.1,start=-11.135", 11),
            71.52)};
    Model believed = motor(weak);
    believed.effects.erase(believed.effects.begin() + 1); // Coulomb friction
    const Diagnosis d = diagnose(believed, prepare_all(away, {}));
    ASSERT_EQ(d.candidates.front().effect, "coulomb");
    ASSERT_TRUE(d.candidates.front().fit.homing.moved(1));

    const std::string strong = variable(0.266471, 3.594642, -1.644002);
    const std::vector<Capture> homed = {
        run(motor(strong), "stroke=4.565,velocity=35.795,acceleration=1306.0,start=-10.747", 510),
        run(motor(strong), "stroke=12.287,velocity=24.267,acceleration=1821.0,start=17.558", 511)};
    const auto motions = prepare_all(homed, {});
    Assembler assembler(motions);
    const FitResult before = fit_homed(motor(), assembler);
    const FitResult after = fit_with(before, *find_effect("variable_inertia"), assembler);
    EXPECT_TRUE(after.homing.all_moved().empty());
}

TEST(Homing, OfAnAxisThatIsKnownIsFoundBeforeTheFit) {
    const Model truth = motor(std::string(kCogging) + kGravity);
    const std::vector<Capture> captures = captures_of(truth, {0, 4.0, -2.0});
    const FitResult f = fitted_at(truth, captures);
    ASSERT_EQ(f.homing.all_moved().size(), 2u);
    const double zeros[] = {0, 4.0, -2.0};
    for (size_t i : {1u, 2u}) {
        const Estimate& offset = f.homing.offset[i];
        EXPECT_LT(std::abs(apart(offset.value, zeros[i], kTurn)), 3 * offset.std);
    }
    const double homed = fitted_at(truth, captures_of(truth, {0, 0, 0})).torque_error;
    std::printf("figure: known cogging and gravity, error %.3g %%, homed %.3g %%\n",
                100 * f.torque_error, 100 * homed);
    EXPECT_LT(f.torque_error, 1.02 * homed);
    EXPECT_EQ(f.free_parameters,
              fitted_at(truth, captures_of(truth, {0, 0, 0})).free_parameters + 2);
}

TEST(Homing, CapturesThatWereHomedHaveNoOffset) {
    for (const char* table : {kCogging, kRipple, kGravity}) {
        const Model truth = motor(table);
        const std::vector<Capture> captures = captures_of(truth, {0, 0, 0});
        EXPECT_TRUE(fitted_at(truth, captures).homing.all_moved().empty()) << table;
        const Diagnosis d = diagnose(motor(), prepare_all(captures, {}));
        EXPECT_TRUE(d.candidates.front().fit.homing.all_moved().empty()) << table;
        EXPECT_TRUE(compare(truth, prepare_all(captures, {})).homing.all_moved().empty()) << table;
    }
}

TEST(Homing, OfACoggingThatIsHardlyThereIsNotClaimed) {
    const Model faint = motor("[[effects.cogging]]\namplitude = 2e-5\norder = 6.0\nphase = 0.7\n");
    for (const std::vector<double>& zeros : {std::vector{0.0, 0.31}, {0.2, -12.9, 1.234}})
        EXPECT_TRUE(fitted_at(faint, captures_of(faint, zeros)).homing.all_moved().empty());
}

TEST(Homing, ATwinStandsWhereItsCaptureDid) {
    const Model truth = motor(kGravity);
    const std::vector<Capture> captures = captures_of(truth, {0, 2.2});
    const auto motions = prepare_all(captures, {});
    const Homing known{{{0, 0}, {2.2, 0}}}, none;
    const auto miss = [&](const Homing& homing) {
        const auto twins = make_twins({truth, homing}, motions, 0, 1);
        return twins ? (twins->motions[1].torque - motions[1].torque).norm() /
                           motions[1].torque.norm()
                     : NAN;
    };
    std::printf("figure: twin at its zero misses %.3g %% of the torque, at another %.3g %%\n",
                100 * miss(known), 100 * miss(none));
    EXPECT_LT(miss(known), 0.3 * miss(none));
}

TEST(Homing, RefineValidatesOnACaptureWithAnotherZero) {
    const Model truth = motor(kCogging);
    const std::vector<Capture> captures = captures_of(truth, {0, 0.31, -0.27});
    const auto motions = prepare_all(captures, {});
    const Refinement r = refine(motor(), {motions[0], motions[1]}, {motions[2]});
    ASSERT_GE(r.ladder.size(), 2u);
    EXPECT_EQ(r.ladder[1].added, "cogging");
    const Rung& last = r.ladder.back();
    std::printf("figure: refine, fitted error %.3g %%, of a capture with another zero %.3g %%\n",
                100 * last.torque_error, 100 * last.validation_error);
    EXPECT_LT(last.validation_error, 1.3 * last.torque_error);
    ASSERT_TRUE(r.validation_homing.moved(0));
    const Estimate& zero = r.validation_homing.offset[0];
    EXPECT_LT(std::abs(apart(zero.value, -0.27, kTurn / 6)), 0.01);
}

TEST(Homing, OneCaptureHasNoOffsetAndAModelOfAnotherRecordingIsNamed) {
    const Model truth = motor(kCogging);
    const std::vector<Capture> captures = captures_of(truth, {0.31});
    const auto motions = prepare_all(captures, {});
    EXPECT_TRUE(fitted_at(truth, captures).homing.offset.empty());
    const Comparison c = compare(truth, motions);
    EXPECT_TRUE(c.homing.all_moved().empty());
    const auto zero = offset_against(truth, motions.front());
    ASSERT_TRUE(zero);
    EXPECT_NEAR(apart(zero->offset.value, 0.31, kTurn / 6), 0, 0.01);
    EXPECT_NEAR(zero->error_before, c.torque_error, 0.02 * c.torque_error);
    EXPECT_LT(zero->error, 0.5 * zero->error_before);
    const std::vector<Capture> own = captures_of(truth, {0});
    EXPECT_FALSE(offset_against(truth, prepare_all(own, {}).front()));
}

TEST(Fit, AFixedOrderLeavesTheAmplitudeFreeAndAFixedPhaseStays) {
    Model model = motor(kCogging);
    const std::vector<Capture> captures = captures_of(model, {0});
    model.effects.back().parameters["amplitude"] = 1e-3;
    model.effects.back().parameters["phase"] = 0.2;
    model.effects.back().fixed = {"order"};
    const auto motions = prepare_all(captures, {});
    EXPECT_NEAR(fit(model, motions).model.effects.back().at("amplitude"), 8e-3, 4e-4);
    model.effects.back().fixed = {"phase"};
    EXPECT_NEAR(fit(model, motions).model.effects.back().at("phase"), 0.2, 1e-9);
}
