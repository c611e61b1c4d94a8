// A studio's session: steps, undo, what is refused, and several who look on at once.
#include "motion_helpers.hpp"
#include "studio/studio.hpp"

#include "common/error.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <thread>

namespace servoid::studio {
namespace {

using namespace std::chrono_literals;

// 0.01·a + 0.05·v + 0.3·sgn v, and what the tests believe of it.
Capture axis(double duration_s = 6) {
    return sampled(
        [](const Kinematics& k, double) {
            return 0.01 * k.acceleration + 0.05 * k.velocity + 0.3 * (k.velocity > 0 ? 1 : -1);
        },
        duration_s);
}

Setup setup() {
    Setup out;
    out.model.name = "axis";
    out.model.inertia = 0.02;
    out.model_source = source_of("axis.toml", "");
    out.recordings = {{axis(), source_of("made", ""), true}};
    out.read = [](const std::string&) { return std::vector<Capture>{axis(4)}; };
    out.diagnose_at_once = false;
    return out;
}

// The state once nothing is being done or waits.
Json settled(Studio& studio) {
    Json state = studio.state(-1, 0ms);
    for (int i = 0; i < 600; ++i) {
        std::this_thread::sleep_for(20ms);
        Json next = studio.state(-1, 0ms);
        if (next["busy"].is_null() && next["revision"] == state["revision"]) return next;
        state = std::move(next);
    }
    ADD_FAILURE() << "never settled: " << state["busy"];
    return state;
}

Json after(Studio& studio, const Json& action) {
    studio.act(action);
    return settled(studio);
}

double error_of(const Json& state) { return state["history"].back()["torque_error"]; }

double value_of(const Json& state, const std::string& name) {
    for (const Json& term : state["model"]["terms"])
        for (const Json& p : term["parameters"])
            if (p["name"] == name) return p["value"];
    ADD_FAILURE() << "no parameter " << name;
    return 0;
}

TEST(Studio, AddingWhatIsMissingBringsTheErrorDown) {
    Studio studio(setup());
    const double opened = error_of(settled(studio));
    const double coulomb = error_of(after(studio, {{"action", "add"}, {"effect", "coulomb"}}));
    const Json both = after(studio, {{"action", "add"}, {"effect", "viscous"}});
    EXPECT_LT(coulomb, 0.5 * opened);
    EXPECT_LT(error_of(both), 0.02);
    EXPECT_NEAR(value_of(both, "coulomb.torque"), 0.3, 0.003);
    EXPECT_NEAR(value_of(both, "viscous.coefficient"), 0.05, 0.001);
    EXPECT_NEAR(both["model"]["inertia"]["value"].get<double>(), 0.01, 1e-4);
    EXPECT_EQ(both["history"].size(), 3U);
    EXPECT_TRUE(both["error"].is_null());
}

TEST(Studio, UndoIsExactAndWhatIsDoneAfterItDropsTheRest) {
    Studio studio(setup());
    after(studio, {{"action", "add"}, {"effect", "coulomb"}});
    const Json before = settled(studio);
    after(studio, {{"action", "add"}, {"effect", "viscous"}});
    const Json undone = after(studio, {{"action", "undo"}});
    EXPECT_EQ(undone["model"], before["model"]);
    EXPECT_EQ(undone["history"], before["history"]);
    EXPECT_EQ(undone["redo"], "+ viscous");
    EXPECT_EQ(undone["undo"], "+ coulomb");
    const Json other = after(studio, {{"action", "add"}, {"effect", "constant_torque"}});
    EXPECT_TRUE(other["redo"].is_null());
    for (int i = 0; i < 5; ++i)
        studio.act({{"action", "undo"}});
    EXPECT_TRUE(settled(studio)["undo"].is_null());
}

TEST(Studio, ANumberOfTheUsersIsNotFittedUntilAsked) {
    Studio studio(setup());
    after(studio, {{"action", "add"}, {"effect", "coulomb"}});
    const double fitted = error_of(settled(studio));
    const Json set = after(studio, {{"action", "set"}, {"name", "coulomb.torque"}, {"value", 0.1}});
    EXPECT_EQ(value_of(set, "coulomb.torque"), 0.1);
    EXPECT_GT(error_of(set), fitted);
    EXPECT_EQ((*studio.story())["basis"], "as given");
    EXPECT_NEAR(error_of(after(studio, {{"action", "fit"}})), fitted, 1e-9);
    EXPECT_EQ((*studio.story())["basis"], "fitted");
    after(studio, {{"action", "set"}, {"name", "coulomb.torque"}, {"value", 0.1}});
    after(studio, {{"action", "fix"}, {"name", "coulomb.torque"}, {"fixed", true}});
    EXPECT_EQ(value_of(after(studio, {{"action", "fit"}}), "coulomb.torque"), 0.1);
}

TEST(Studio, TermsThatAreOffAreKept) {
    Studio studio(setup());
    after(studio, {{"action", "add"}, {"effect", "coulomb"}});
    const Json both = after(studio, {{"action", "add"}, {"effect", "viscous"}});
    const Json off = after(studio, {{"action", "turn"}, {"index", 0}, {"on", false}});
    EXPECT_GT(error_of(off), 0.1);
    EXPECT_EQ(off["model"]["terms"][1]["effect"], "coulomb");
    EXPECT_EQ(off["model"]["terms"][1]["on"], false);
    EXPECT_EQ(parse_model(studio.model_toml(), "saved").effects.size(), 1U);
    const Json on = after(studio, {{"action", "turn"}, {"index", 1}, {"on", true}});
    EXPECT_NEAR(error_of(on), error_of(both), 1e-9);
    const Json removed = after(studio, {{"action", "remove"}, {"index", 1}});
    EXPECT_EQ(removed["model"]["terms"].size(), 1U);
}

TEST(Studio, WhatMakesNoSenseIsRefusedAndChangesNothing) {
    Studio studio(setup());
    const Json before = settled(studio);
    for (const Json& action :
         std::vector<Json>{Json::object(),
                           {{"action", "dance"}},
                           {{"action", "add"}},
                           {{"action", 5}},
                           {{"action", "remove"}, {"index", -1}},
                           {{"action", "remove"}, {"index", 0.5}},
                           {{"action", "set"}, {"name", "inertia"}, {"value", "2"}},
                           {{"action", "run"}, {"experiment", "sine"}},
                           {{"action", "turn"}, {"index", 0}, {"on", 1}}})
        EXPECT_THROW(studio.act(action), UsageError) << action;
    EXPECT_THROW(studio.act(Json::array()), UsageError);
    for (const Json& action :
         std::vector<Json>{{{"action", "add"}, {"effect", "nonsense"}},
                           {{"action", "add"}, {"law", "k*("}, {"name", "x"}},
                           {{"action", "add"}, {"law", "k*v"}, {"name", "a b"}},
                           {{"action", "remove"}, {"index", 7}},
                           {{"action", "set"}, {"name", "inertia"}, {"value", -1}},
                           {{"action", "set"}, {"name", "coulomb.torque"}, {"value", 1}},
                           {{"action", "experiment"}},
                           {{"action", "capture"}, {"file", "made"}, {"on", false}}}) {
        const Json state = after(studio, action);
        EXPECT_TRUE(state["error"].is_string()) << action;
        EXPECT_EQ(state["model"], before["model"]) << action;
        EXPECT_EQ(state["captures"], before["captures"]) << action;
        EXPECT_EQ(state["history"].size(), 1U) << action;
    }
    EXPECT_TRUE(after(studio, {{"action", "add"}, {"effect", "coulomb"}})["error"].is_null());
}

TEST(Studio, CapturesComeAndGo) {
    Studio studio(setup());
    studio.add_capture("other.csv", "bytes");
    const Json two = settled(studio);
    ASSERT_EQ(two["captures"].size(), 2U);
    EXPECT_EQ(two["captures"][1]["file"], "other.csv");
    EXPECT_EQ((*studio.story())["captures"].size(), 2U);
    EXPECT_EQ((*studio.story())["captures"][1]["sha256"], source_of("", "bytes").sha256);
    const Json one = after(studio, {{"action", "capture"}, {"file", "made"}, {"on", false}});
    EXPECT_EQ(one["captures"][0]["on"], false);
    EXPECT_EQ((*studio.story())["captures"][0]["file"], "other.csv");
    after(studio, {{"action", "undo"}});
    EXPECT_EQ((*studio.story())["captures"].size(), 2U);
}

TEST(Studio, ADiagnosisIsOfTheStepAndCanBeStopped) {
    Studio studio(setup());
    const Json state = after(studio, {{"action", "diagnose"}});
    EXPECT_EQ(state["history"].size(), 1U); // no step of its own
    EXPECT_EQ((*studio.story())["diagnose"]["candidates"][0]["effect"], "viscous");
    studio.act({{"action", "refine"}});
    std::this_thread::sleep_for(30ms);
    studio.act({{"action", "stop"}});
    const Json stopped = settled(studio);
    EXPECT_EQ(stopped["history"].size(), 1U);
    EXPECT_TRUE(stopped["error"].is_null());
    EXPECT_EQ((*studio.story())["verdict"], "missing");
}

TEST(Studio, WhoWaitsIsTold) {
    Studio studio(setup());
    const long revision = settled(studio)["revision"];
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(studio.state(revision, 150ms)["revision"], revision);
    EXPECT_GE(std::chrono::steady_clock::now() - begin, 140ms);
    std::thread late([&] {
        std::this_thread::sleep_for(50ms);
        studio.act({{"action", "add"}, {"effect", "coulomb"}});
    });
    EXPECT_GT(studio.state(revision, 20s)["revision"].get<long>(), revision);
    late.join();
    studio.wake(); // the end of the program waits for nobody
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
    studio.state(1'000'000, 20s);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

// Every state that anybody sees is one that was: never the model of one step with the error of
// another.
TEST(Studio, WhatIsSeenIsConsistent) {
    Studio studio(setup());
    std::atomic<bool> done = false;
    std::atomic<long> seen = 0;
    std::vector<std::thread> tabs;
    for (int i = 0; i < 3; ++i)
        tabs.emplace_back([&] {
            long revision = -1;
            while (!done) {
                const Json state = studio.state(revision, 20ms);
                EXPECT_GE(state["revision"].get<long>(), revision);
                revision = state["revision"];
                EXPECT_EQ(state["model"]["terms"].size() + 1, state["history"].size());
                const auto story = studio.story();
                EXPECT_EQ((*story)["captures"].size(), 1U);
                ++seen;
            }
        });
    for (const char* effect : {"coulomb", "viscous", "constant_torque"})
        studio.act({{"action", "add"}, {"effect", effect}});
    for (int i = 0; i < 3; ++i)
        studio.act({{"action", "undo"}});
    settled(studio);
    done = true;
    for (std::thread& tab : tabs)
        tab.join();
    EXPECT_GE(seen, 3);
}

} // namespace
} // namespace servoid::studio
