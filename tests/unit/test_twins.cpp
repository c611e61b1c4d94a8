// Twins: what a model does in its own loop, and what the method leaves of a model that is complete.
#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/loop_twin.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/structure.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"
#include "unit/drive_helpers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace servoid;

namespace {

Capture capture_of(const Model& truth, const std::string& move, unsigned long seed = 3) {
    return simulate(truth, parse_experiment(move), seed);
}

double position_miss(const Capture& a, const Capture& b) {
    double most = 0;
    for (size_t i = 0; i < a.rows(); ++i)
        most = std::max(most, std::abs(a.position[i] - b.position[i]));
    return most;
}

Model example(const std::string& name) {
    return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/" + name);
}

Capture every(size_t nth, const Capture& c) {
    Capture out = c;
    for (auto* v : {&out.time_s, &out.torque_ref, &out.position, &out.position_ref}) {
        std::vector<double> kept;
        for (size_t i = 0; i < v->size(); i += nth)
            kept.push_back((*v)[i]);
        *v = std::move(kept);
    }
    out.velocity.clear();
    out.sample_time_s *= double(nth);
    out.ref_held = false; // the torque of one period of four
    out.torque_delay_s = c.sample_time_s / 2;
    return out;
}

Capture without_first(Capture c, size_t rows) {
    for (auto* v : {&c.time_s, &c.torque_ref, &c.position, &c.position_ref})
        if (!v->empty()) v->erase(v->begin(), v->begin() + long(rows));
    for (double& t : c.time_s)
        t -= double(rows) * c.sample_time_s;
    return c;
}

constexpr const char* kSlowTurns = "trapezoid:stroke=2,velocity=8,acceleration=100,cycles=3";
constexpr const char* kMultisine =
    "multisine:from_Hz=2,to_Hz=80,step_Hz=2,amplitude=0.5,periods=6,torque_noise=3e-3";

} // namespace

TEST(LoopTwin, OfTheTruthIsTheCapture) {
    const Model truth = drive();
    const Capture capture = capture_of(truth, std::string(kSlowTurns) + ",rest=0.01");
    const auto twin = loop_twin(truth, capture);
    ASSERT_TRUE(twin);
    EXPECT_EQ(twin->position, capture.position);
    EXPECT_EQ(twin->torque_ref, capture.torque_ref);
}

TEST(LoopTwin, StartsInsideARepeatedMotionWithItsIntegratorFilled) {
    const Model truth = drive("[effects.constant_torque]\ntorque = 0.05\n");
    const Capture whole = capture_of(truth, "sine:frequency_Hz=5,periods=6,amplitude=1");
    Capture later = without_first(whole, 1600);
    later.period_s = 0.2;
    const auto twin = loop_twin(truth, later);
    ASSERT_TRUE(twin);
    const double counts = position_miss(*twin, later) / later.position_quantum;
    std::printf("figure: twin from the second period on, farthest = %.1f counts\n", counts);
    EXPECT_LT(counts, 30); // of some 41700 in the stroke
}

TEST(LoopTwin, NeedsALoopAReferenceAndAPosition) {
    const Capture capture = capture_of(drive(), kSlowTurns);
    Model no_loop = drive();
    no_loop.controller.reset();
    EXPECT_FALSE(loop_twin(no_loop, capture));
    Capture no_reference = capture;
    no_reference.position_ref.clear();
    EXPECT_FALSE(loop_twin(drive(), no_reference));
    Capture other_rate = capture;
    other_rate.sample_time_s *= 1.5;
    EXPECT_FALSE(loop_twin(drive(), other_rate));
}

// A slow log of a fast loop: every fourth row.
TEST(LoopTwin, SimulatesThePeriodsThatWereNotRecorded) {
    const Model truth = drive();
    const Capture whole = capture_of(truth, std::string(kSlowTurns) + ",rest=0.01");
    const Capture fourth = every(4, whole);
    const auto twin = loop_twin(truth, fourth);
    ASSERT_TRUE(twin);
    const double counts = position_miss(*twin, fourth) / fourth.position_quantum;
    std::printf("figure: twin of every fourth row, farthest = %.1f counts\n", counts);
    EXPECT_LT(counts, 10); // of some 41700 in the stroke: the reference between rows is straight
}

// Small moves about a standstill that no two models share: what a twin leaves is there to see.
TEST(Twins, TakeOutWhatTheMethodLeavesOfACompleteModel) {
    const Model truth = example("system1.toml");
    const std::vector<Capture> captures = {capture_of(truth, "multisine:to_Hz=12")};
    const auto motions = prepare_all(captures, {});
    Assembler assembler(motions);
    const FitResult raw = fit(truth, assembler);
    const FitResult freed = without_artifact(raw, assembler, 2);
    std::printf(
        "figure: complete model, small multisine, error = %.3g %%, without what twins leave "
        "%.3g %%\n",
        100 * raw.torque_error, 100 * freed.torque_error);
    EXPECT_LT(freed.torque_error, 0.75 * raw.torque_error);
    EXPECT_EQ(diagnose(truth, motions).verdict, Verdict::adequate);
    EXPECT_NEAR(freed.model.inertia, truth.inertia, 0.01 * truth.inertia);
}

// Where a stiff loop answers noise with torque far above what moves the axis, a delay or an elastic
// load takes up a third of an error in which nothing is missing.
TEST(Twins, NoiseGainsAsMuchWithoutAnEffect) {
    Model truth = drive();
    truth.controller->speed_gain = 5e-2;
    const std::vector<Capture> captures = {capture_of(
        truth,
        "multisine:from_Hz=2,to_Hz=20,step_Hz=2,amplitude=0.05,periods=2,torque_noise=2e-2")};
    const auto motions = prepare_all(captures, {400.0, {}});
    Assembler assembler(motions);
    const FitResult before = fit(truth, assembler);
    for (const char* name : {"elastic_load", "dead_time", "torque_lag"}) {
        const Effect& effect = *find_effect(name);
        const FitResult after = fit_with(before, effect, assembler);
        const double gain =
            std::log(held_out_error(before, assembler) / held_out_error(after, assembler));
        const auto noise = gain_from_noise(before, effect, assembler);
        ASSERT_TRUE(noise);
        std::printf("figure: %s on noise gains %.3f, on twins %.3f\n", name, gain, *noise);
        EXPECT_GT(gain, 0.1) << name;
        EXPECT_GT(*noise, 0.7 * gain) << name;
    }
    EXPECT_EQ(diagnose(truth, motions).verdict, Verdict::adequate);
}

TEST(Structure, IsSeenOfALawWithoutANameAndNotOfNoise) {
    const Model known = drive();
    const Model truth = drive("[effects.custom.cubic]\nlaw = \"k*theta^3\"\n"
                              "[effects.custom.cubic.parameters]\nk = 1e-2\n");
    for (const bool hidden : {false, true}) {
        const std::vector<Capture> captures = {
            capture_of(hidden ? truth : known, std::string(kSlowTurns) + ",torque_noise=2e-3")};
        const auto motions = prepare_all(captures, {});
        Assembler assembler(motions);
        const FitResult fitted = fit(known, assembler);
        const Structure s = structure_of(fitted, held_out_error(fitted, assembler), assembler);
        EXPECT_EQ(s.evident.has_value(), hidden);
        if (s.evident) {
            EXPECT_EQ(s.evident->name, "position");
        }
    }
}

TEST(Diagnose, ACubicSpringIsUnknownAndOnesOwnLawBringsItToTheFloor) {
    const Model known = drive();
    const Model truth = drive("[effects.custom.cubic]\nlaw = \"k*theta^3\"\n"
                              "[effects.custom.cubic.parameters]\nk = 1e-2\n");
    const std::vector<Capture> captures = {
        capture_of(truth, std::string(kSlowTurns) + ",torque_noise=2e-3")};
    const auto motions = prepare_all(captures, {});
    const Diagnosis d = diagnose(known, motions);
    EXPECT_EQ(d.verdict, Verdict::unknown) << d.advice;
    const std::vector<Capture> free = {
        capture_of(known, std::string(kSlowTurns) + ",torque_noise=2e-3")};
    const double floor = fit(known, prepare_all(free, {})).torque_error;
    const double error = fit(truth, motions).torque_error;
    std::printf("figure: cubic spring, error with one's own law = %.3g %%, floor %.3g %%\n",
                100 * error, 100 * floor);
    EXPECT_LT(error, 1.1 * floor);
}

TEST(Fit, HoldsAnInertiaThatAMissingLawTurnsOverAndRefusesAReversedTorque) {
    // Slow turns under strong gravity: the spring-like part of it is larger than J·ω².
    const Model truth = drive("[effects.gravity]\ntorque = 0.3\nphase = 0.0\n");
    std::vector<Capture> captures = {
        capture_of(truth, "sine:frequency_Hz=2,periods=4,amplitude=1")};
    const FitResult held = fit(drive(), prepare_all(captures, {}));
    EXPECT_GT(held.model.inertia, 0);
    const Diagnosis d = diagnose(drive(), prepare_all(captures, {}));
    ASSERT_FALSE(d.candidates.empty());
    EXPECT_TRUE(d.candidates[0].effect == "gravity" || d.candidates[0].effect == "spring");

    captures = {capture_of(drive(), kMultisine)};
    for (double& t : captures[0].torque_ref)
        t = -t;
    EXPECT_THROW(fit(drive(), prepare_all(captures, {})), Refusal);
}
