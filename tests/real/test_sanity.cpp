// Measured captures are no suspects; the same ones spoilt are.
#include "compare/compare.hpp"
#include "diagnose/sanity.hpp"
#include "real/measured.hpp"

#include <algorithm>

using namespace servoid;
using namespace servoid::measured;

namespace {

std::vector<Suspicion> said_of(const Model& model, const Capture& capture) {
    const std::vector<Capture> captures = {capture};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {});
    return suspicions(model, motions);
}

void expect_nothing(const Model& model, const Capture& capture) {
    for (const Suspicion& s : said_of(model, capture))
        ADD_FAILURE() << capture.path << ": " << s.sentence;
}

Model rotary(const std::string& inertia, const std::string& effects) {
    return parse_model("motion = \"rotary\"\n[plant]\ninertia = " + inertia + "\n" + effects, "m");
}

// EMPS as it is known, with the published friction.
Model known_emps() {
    return parse_model("motion = \"linear\"\n[plant]\ninertia = 95\n"
                       "[effects.viscous]\ncoefficient = 205\n[effects.coulomb]\ntorque = 20\n"
                       "[effects.constant_torque]\ntorque = -3.1\n",
                       "emps");
}

Capture with_torque(Capture c, double factor, long later) {
    const std::vector<double> was = c.torque_ref;
    for (long i = 0; i < long(c.rows()); ++i)
        c.torque_ref[size_t(i)] =
            factor * was[size_t(std::clamp(i - later, 0L, long(c.rows()) - 1))];
    return c;
}

} // namespace

TEST(Sanity, EmpsIsNoSuspect) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture capture = read_capture(emps_csv());
    expect_nothing(emps_model(), capture);
    expect_nothing(known_emps(), capture);
    Model wrong = known_emps();
    wrong.inertia /= 3;
    expect_nothing(wrong, capture);
}

TEST(Sanity, EmpsSpoiltIsNamed) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture good = read_capture(emps_csv());
    struct Spoilt {
        double factor;
        long later;
        const char* words;
    };
    for (const Spoilt& s :
         {Spoilt{-1, 0, "torque looks reversed"}, Spoilt{1000, 0, "force in mN, read as N"},
          Spoilt{1, 3, "ms (3.18 samples) after the motion it causes"},
          Spoilt{1, 200, "(200 samples) after the motion it causes"},
          Spoilt{1, -200, "more than a loop survives"}, Spoilt{1.3, 0, "1.31 times what is"}}) {
        const auto found = said_of(known_emps(), with_torque(good, s.factor, s.later));
        const std::string said = found.empty() ? "nothing" : found[0].sentence;
        figure("EMPS spoilt", said, s.words);
        EXPECT_NE(said.find(s.words), std::string::npos) << said;
    }
    expect_nothing(known_emps(), with_torque(good, 1, -3)); // three milliseconds of dead time
}

TEST(Sanity, TheOtherMachinesAreNoSuspects) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/motor_bench/motor_bench.csv");
    expect_nothing(rotary("0.02", "[effects.viscous]\ncoefficient = 0.01\n"),
                   read_capture(data_folder() + "/motor_bench/motor_bench.csv"));
    const Model epos = rotary("1e-6", "[effects.viscous]\ncoefficient = 2.3e-5\n"
                                      "[effects.coulomb]\ntorque = 2.9e-3\n");
    int files = 0;
    for (const auto& file : std::filesystem::directory_iterator(data_folder() + "/epos_drive1")) {
        expect_nothing(epos, read_capture(file.path()));
        ++files;
    }
    EXPECT_EQ(files, 34);
    expect_nothing(epos, read_capture(data_folder() + "/odrive_slow/odrive_slow.csv"));
}
