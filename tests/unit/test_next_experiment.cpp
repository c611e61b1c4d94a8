// The proposed next experiment: what it separates when it is really made, and what it keeps to.
#include "diagnose/add_effect.hpp"
#include "diagnose/advice.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/move_menu.hpp"
#include "diagnose/next_experiment.hpp"
#include "diagnose/rival_record.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

using namespace servoid;

namespace {

EffectTerm term(const std::string& name, const std::map<std::string, double>& parameters) {
    EffectTerm out;
    out.name = name, out.parameters = parameters;
    return out;
}

// The paper's motor in its loop, with the given effects.
Model motor(const std::vector<EffectTerm>& effects) {
    Model model = read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system1.toml");
    model.effects = effects;
    return model;
}

const EffectTerm kCoulomb = term("coulomb", {{"torque", 6.6e-3}});
const EffectTerm kViscous = term("viscous", {{"coefficient", 0.75e-4}});

Capture later(Capture c, double skip_s) {
    const auto skip = long(std::lround(skip_s / c.sample_time_s));
    for (std::vector<double>* column : {&c.position, &c.position_ref, &c.torque_ref, &c.time_s})
        column->erase(column->begin(), column->begin() + skip);
    for (double& t : c.time_s)
        t -= skip_s;
    return c;
}

// A capture with the motions that point into it.
struct Recorded {
    // Without the start, where a record of one speed would show others.
    Recorded(const Model& truth, const std::string& experiment, unsigned long seed,
             double skip_s = 0)
        : captures{later(simulate(truth, parse_experiment(experiment), seed), skip_s)},
          motions(prepare_all(captures, {})) {}
    Recorded(const Recorded&) = delete;
    std::vector<Capture> captures;
    std::vector<PreparedMotion> motions;
};

std::vector<Model> rivals_of(const Model& base, const std::vector<std::string>& effects,
                             const Recorded& r, double& noise) {
    std::vector<Model> out;
    noise = INFINITY;
    for (const std::string& effect : effects) {
        const FitResult f = add_effect(base, effect, r.motions).after;
        out.push_back(f.model);
        noise = std::min(noise, f.residual.norm() / std::sqrt(double(f.residual.size())));
    }
    return out;
}

struct Proposed {
    std::vector<Model> rivals;
    std::optional<NextExperiment> next;
    double noise = 0;
};

Proposed propose(const char* what, const Model& base, const std::vector<std::string>& effects,
                 const Recorded& r) {
    Proposed out;
    out.rivals = rivals_of(base, effects, r, out.noise);
    const std::clock_t from = std::clock();
    out.next = next_experiment(out.rivals, r.motions, out.noise);
    const double took = double(std::clock() - from) / CLOCKS_PER_SEC;
    if (out.next)
        std::printf("figure: %s: %s, separation %.3g, %.2f s\n        %s\n", what,
                    out.next->experiment.c_str(), out.next->separation, took,
                    out.next->reason.c_str());
    else
        std::printf("figure: %s: nothing, %.2f s\n", what, took);
    return out;
}

std::string with_noise(const std::string& experiment, double torque_noise) {
    return experiment + ",torque_noise=" + std::to_string(torque_noise);
}

// Its richer forms count with it: they are the same with more freedom.
double probability_of(const std::string& effect, const Diagnosis& d) {
    double sum = 0;
    for (const Candidate& c : d.candidates)
        if (c.effect == effect || is_richer_form(c.effect, effect)) sum += c.probability;
    return sum;
}

void print(const char* what, const Diagnosis& d) {
    std::printf("figure: %s: %s, %s %.3f, %s %.3f\n", what, verdict_name(d.verdict),
                d.candidates[0].effect.c_str(), d.candidates[0].probability,
                d.candidates[1].effect.c_str(), d.candidates[1].probability);
}

// What a case is: an axis, what the model lacks, and a record that cannot tell the rivals apart.
struct Case {
    const char* name;
    Model base, truth;
    std::vector<std::string> rivals; // the true one first
    std::string recorded;
    double torque_noise;
    double skip_s = 0;
};

void expect_within(const MoveLimits& limits, const Model& truth, const NextExperiment& next) {
    const Use use = use_of(simulate(truth, parse_experiment(next.experiment), 1), limits);
    std::printf("figure: used of the limits: travel %.2f, speed %.2f, torque %.2f\n", use.travel,
                use.speed, use.torque);
    EXPECT_LT(use.travel, 1.02);
    EXPECT_LT(use.speed, 1.02);
    EXPECT_LT(use.torque, 1.05); // the truth is not exactly what was fitted
    EXPECT_GT(use.most(), 0.1);
}

// The old record cannot tell, the proposed one can. Returns the motions before and after.
struct Records {
    std::unique_ptr<Recorded> old, next;
};

Records old_cannot_new_can(const Case& c) {
    Records out;
    out.old =
        std::make_unique<Recorded>(c.truth, with_noise(c.recorded, c.torque_noise), 3, c.skip_s);
    const Diagnosis before = diagnose(c.base, out.old->motions);
    print(c.name, before);
    EXPECT_LT(probability_of(c.rivals[0], before), 0.9) << "the old record was enough";
    const Proposed p = propose(c.name, c.base, c.rivals, *out.old);
    if (!p.next) {
        ADD_FAILURE() << "no proposal";
        return out;
    }
    EXPECT_GT(p.next->separation, kWorthRecording);
    expect_within(limits_of(c.base, out.old->motions), c.truth, *p.next);
    out.next =
        std::make_unique<Recorded>(c.truth, with_noise(p.next->experiment, c.torque_noise), 4);
    const Diagnosis after = diagnose(c.base, out.next->motions);
    print(c.name, after);
    EXPECT_EQ(after.candidates[0].effect, c.rivals[0]);
    EXPECT_GT(probability_of(c.rivals[0], after), 0.9);
    return out;
}

// An effect that the motor with its friction hides, in a record that cannot tell what it is.
struct Hidden {
    Hidden(const EffectTerm& effect, const std::string& move)
        : base(motor({kViscous, kCoulomb})), truth(motor({kViscous, kCoulomb, effect})),
          old(truth, with_noise(move, 5e-4), 3) {}
    Model base, truth;
    Recorded old;
};

// How far the speeds of a record are apart: the fast tenth over the slow quarter.
double speed_range(const PreparedMotion& m) {
    std::vector<double> speed;
    for (double v : m.velocity)
        speed.push_back(std::abs(v));
    std::sort(speed.begin(), speed.end());
    return speed[speed.size() * 9 / 10] / speed[speed.size() / 4];
}

} // namespace

TEST(NextExperiment, ViscousOrDrag) {
    const Model base = motor({kCoulomb});
    const Model truth = motor({kCoulomb, term("quadratic_drag", {{"coefficient", 4e-6}})});
    old_cannot_new_can({"viscous or drag",
                        base,
                        truth,
                        {"quadratic_drag", "viscous"},
                        "trapezoid:stroke=6.28,velocity=12,acceleration=2000,cycles=4",
                        5e-4});
}

TEST(NextExperiment, CoulombOrConstantTorqueTakesBothDirections) {
    const Records r = old_cannot_new_can({"Coulomb or constant torque",
                                          motor({kViscous}),
                                          motor({kViscous, kCoulomb}),
                                          {"coulomb", "constant_torque"},
                                          "constant_speed:velocity=20,duration=1",
                                          5e-4});
    ASSERT_TRUE(r.next);
    EXPECT_GT(r.old->motions[0].velocity.minCoeff(), -0.1);
    EXPECT_LT(r.next->motions[0].velocity.minCoeff(), -1);
    EXPECT_GT(r.next->motions[0].velocity.maxCoeff(), 1);
}

TEST(NextExperiment, CoggingOrDisturbanceTakesOtherSpeeds) {
    Model base = motor({kViscous, kCoulomb});
    base.inertia_fixed = true; // one speed does not show it
    const EffectTerm cogging = term("cogging", {{"amplitude", 1e-3}, {"order", 7}, {"phase", 0.5}});
    const Records r = old_cannot_new_can({"cogging or disturbance",
                                          base,
                                          motor({kViscous, kCoulomb, cogging}),
                                          {"cogging", "periodic_disturbance"},
                                          "constant_speed:velocity=60,duration=1.5",
                                          1e-3,
                                          0.3});
    ASSERT_TRUE(r.next);
    EXPECT_LT(speed_range(r.old->motions[0]), 1.05);
    EXPECT_GT(speed_range(r.next->motions[0]), 1.3);
}

TEST(NextExperiment, LagOrDeadTimeGoesHigher) {
    const Hidden h(term("torque_lag", {{"time_constant", 5e-4}}),
                   "multisine:from_Hz=1,to_Hz=12,step_Hz=1,amplitude=1,periods=4");
    const Proposed p = propose("lag or dead time", h.base, {"torque_lag", "dead_time"}, h.old);
    ASSERT_TRUE(p.next);
    EXPECT_GT(p.next->separation, kWorthRecording);
    const std::string& text = p.next->experiment;
    const size_t at = text.find("to_Hz=");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_GT(std::stod(text.substr(at + 6)), 24) << text;
}

// An arc so small is a line: within the recorded travel nothing helps, and it is said so.
TEST(NextExperiment, SpringOrGravityNeedsMoreTravelThanIsAllowed) {
    const Hidden h(term("gravity", {{"torque", 4e-3}, {"phase", 0}}),
                   "trapezoid:stroke=0.6,velocity=20,acceleration=2000,cycles=8,start=-0.3");
    const Proposed within = propose("gravity or spring", h.base, {"gravity", "spring"}, h.old);
    ASSERT_TRUE(within.next);
    EXPECT_LT(within.next->separation, kWorthRecording);
    MoveLimits wider = limits_of(within.rivals[0], h.old.motions);
    wider.lowest = -2.5, wider.highest = 2.5;
    const auto next = next_experiment(within.rivals, h.old.motions, within.noise, wider);
    ASSERT_TRUE(next);
    std::printf("figure: the same with ±2.5 rad: %s, separation %.3g\n", next->experiment.c_str(),
                next->separation);
    EXPECT_GT(next->separation, 1);
    expect_within(wider, h.truth, *next);
    const Recorded far(h.truth, with_noise(next->experiment, 5e-4), 4);
    const Diagnosis after = diagnose(h.base, far.motions);
    print("gravity or spring, wider", after);
    EXPECT_GT(probability_of("gravity", after), 0.9);
}

// One rival is the other with an effect more: the move that would show it.
TEST(NextExperiment, ShowsAnEffectThatTheRecordDoesNotShow) {
    const EffectTerm drag = term("quadratic_drag", {{"coefficient", 8e-6}});
    const Model without = motor({kViscous, kCoulomb}), with = motor({kViscous, kCoulomb, drag});
    const Recorded old(with, "sine:frequency_Hz=5,amplitude=0.5,periods=20,torque_noise=5e-4", 3);
    const auto next = next_experiment({without, with}, old.motions, 2e-4);
    const auto reverse = next_experiment({with, without}, old.motions, 2e-4);
    ASSERT_TRUE(next && reverse);
    std::printf("figure: to show drag: %s, %.3g\n", next->experiment.c_str(), next->separation);
    EXPECT_GT(next->separation, kWorthRecording);
    EXPECT_NE(next->reason.find("no further effect"), std::string::npos) << next->reason;
    EXPECT_NEAR(next->separation, reverse->separation, 0.5 * next->separation);
}

TEST(NextExperiment, NothingWithoutRivalsOrPositions) {
    const Model model = motor({kViscous, kCoulomb});
    Recorded old(model, "trapezoid:cycles=3", 3);
    EXPECT_FALSE(next_experiment({model}, old.motions, 1e-3));
    EXPECT_FALSE(next_experiment({}, old.motions, 1e-3));
    EXPECT_FALSE(next_experiment({model, motor({kViscous})}, {}, 1e-3));
    Capture& c = old.captures[0];
    c.velocity.assign(c.rows(), 0);
    for (size_t i = 1; i < c.rows(); ++i)
        c.velocity[i] = (c.position[i] - c.position[i - 1]) / c.sample_time_s;
    c.position.clear();
    const std::vector<PreparedMotion> blind = prepare_all(old.captures, {});
    EXPECT_FALSE(next_experiment({model, motor({kViscous})}, blind, 1e-3));
}

// The worst case: four rivals, laws that are searched for and simulated in small steps.
TEST(NextExperiment, FourRivalsTwiceTheSame) {
    const Model base = motor({kViscous, kCoulomb});
    const EffectTerm cogging = term("cogging", {{"amplitude", 5e-4}, {"order", 3}, {"phase", 0.5}});
    const Recorded old(motor({kViscous, kCoulomb, cogging}),
                       "trapezoid:stroke=12,velocity=30,acceleration=2000,cycles=3,"
                       "torque_noise=2e-3",
                       3);
    const std::vector<std::string> names = {"cogging", "variable_inertia", "torque_ripple",
                                            "periodic_disturbance"};
    const Proposed once = propose("four rivals", base, names, old);
    const Proposed twice = propose("four rivals", base, names, old);
    ASSERT_TRUE(once.next && twice.next);
    EXPECT_EQ(once.next->experiment, twice.next->experiment);
    EXPECT_EQ(once.next->separation, twice.next->separation);
}

// Every move of the menu is a text, lasts no longer than allowed and asks for no more travel.
TEST(NextExperiment, TheMenuKeepsItsLimits) {
    MoveLimits limits;
    limits.lowest = -3, limits.highest = 9;
    limits.asked_speed = 40, limits.top_speed = 45, limits.peak_torque = 0.05;
    limits.sample_time_s = 125e-6, limits.position_quantum = 1e-5, limits.longest_s = 4;
    const std::vector<Move> menu = menu_of(limits, 1.16e-5);
    EXPECT_GE(menu.size(), 15u);
    EXPECT_LE(menu.size(), 32u);
    for (const Move& move : menu) {
        for (double effort : {0.3, 1.0}) {
            const std::optional<std::string> text = text_of(move, effort, limits);
            if (!text) continue;
            const Experiment e = parse_experiment(*text);
            EXPECT_LE(e.duration_s, limits.longest_s) << *text;
            for (double t = 0; t < e.duration_s; t += 1e-3) {
                ASSERT_GT(e.position_ref(t), limits.lowest - 0.05) << *text;
                ASSERT_LT(e.position_ref(t), limits.highest + 0.05) << *text;
            }
        }
    }
}

// Without a loop the record is made along the reference: the model that made it leaves nothing.
TEST(NextExperiment, AlongTheReferenceAModelExplainsItself) {
    const std::vector<EffectTerm> extra = {term("torque_lag", {{"time_constant", 5e-4}}),
                                           term("dead_time", {{"delay", 3e-4}}),
                                           term("gravity", {{"torque", 0.01}, {"phase", 0.4}}),
                                           term("elastic_load", {{"antiresonance_frequency", 300},
                                                                 {"resonance_frequency", 420},
                                                                 {"antiresonance_damping", 0.05},
                                                                 {"resonance_damping", 0.05}})};
    MoveLimits limits;
    limits.sample_time_s = 125e-6;
    for (const EffectTerm& effect : extra) {
        Model model = motor({kViscous, kCoulomb, effect});
        model.controller.reset();
        const std::vector<Capture> record = {record_of(
            model, parse_experiment("multisine:from_Hz=1,to_Hz=40,step_Hz=1,amplitude=1,periods=3"),
            limits)};
        const FitResult f = fit(model, prepare_all(record, {}));
        std::printf("figure: %s leaves %.2g of its own torque\n", effect.name.c_str(),
                    f.torque_error);
        EXPECT_LT(f.torque_error, 0.01) << effect.name;
        if (effect.name == "elastic_load") continue; // 40 Hz do not show where it resonates
        for (const auto& [key, value] : effect.parameters)
            EXPECT_NEAR(f.model.find(effect.name)->at(key), value, 0.02 * value) << key;
    }
}

TEST(NextExperiment, WithoutALoopToo) {
    const Model base = motor({kCoulomb});
    const Model truth = motor({kCoulomb, term("quadratic_drag", {{"coefficient", 4e-6}})});
    const Recorded old(truth, "trapezoid:velocity=12,cycles=4,torque_noise=5e-4", 3);
    Model blind = base;
    blind.controller.reset();
    const Proposed p = propose("without a loop", blind, {"quadratic_drag", "viscous"}, old);
    ASSERT_TRUE(p.next);
    EXPECT_GT(p.next->separation, kWorthRecording);
    expect_within(limits_of(base, old.motions), truth, *p.next);
}

TEST(NextExperiment, TheAdviceEndsWithTheMove) {
    const Model base = motor({kCoulomb});
    const Model truth = motor({kCoulomb, term("quadratic_drag", {{"coefficient", 4e-6}})});
    const Recorded old(truth, "trapezoid:velocity=12,cycles=4,torque_noise=5e-4", 3);
    Diagnosis d = diagnose(base, old.motions);
    ASSERT_EQ(d.verdict, Verdict::ambiguous);
    d.next = next_of(d, old.motions);
    ASSERT_TRUE(d.next);
    const std::string advice = advice_for(d);
    EXPECT_NE(advice.find("record --experiment \"" + d.next->experiment + "\""), std::string::npos)
        << advice;
    d.next->separation = 0.01;
    EXPECT_NE(advice_for(d).find("no move within the recorded"), std::string::npos);
    d.next.reset();
    EXPECT_NE(advice_for(d).find("constant speeds"), std::string::npos);
    d.verdict = Verdict::missing;
    EXPECT_FALSE(next_of(d, old.motions));
}
