// EMPS: the error ladder, the published identification, the loop view, the noise floor.
#include "compare/compare.hpp"
#include "diagnose/add_effect.hpp"
#include "identify/identify.hpp"
#include "real/measured.hpp"

using namespace servoid;
using namespace servoid::measured;

namespace {

struct Ladder {
    std::vector<double> error; // mass + offset, + viscous, + Coulomb
    FitResult last;
};

Ladder climb(const Capture& capture, std::optional<double> band_Hz) {
    const std::vector<PreparedMotion> motions = prepare_all({&capture, 1}, {band_Hz, {}});
    const Addition viscous = add_effect(emps_model(), "viscous", motions);
    const Addition coulomb = add_effect(viscous.after.model, "coulomb", motions);
    return {{viscous.before.torque_error, viscous.after.torque_error, coulomb.after.torque_error},
            coulomb.after};
}

double value(const FitResult& fit, const std::string& name) {
    for (size_t i = 0; i < fit.coefficients.size(); ++i)
        if (coefficient_name(fit.model, fit.coefficients[i]) == name)
            return fit.values[Eigen::Index(i)];
    ADD_FAILURE() << name;
    return NAN;
}

Capture as_samples(Capture capture) {
    capture.ref_held = false;
    return capture;
}

void expect_ladder(const Ladder& l, const std::string& how) {
    figure("EMPS, torque error mass+offset -> +viscous -> +Coulomb, " + how,
           fmt::format("{:.2f} -> {:.2f} -> {:.2f} %", 100 * l.error[0], 100 * l.error[1],
                       100 * l.error[2]),
           "about 69 -> 17 -> 4.1 %");
    EXPECT_NEAR(100 * l.error[0], 69, 1.5);
    EXPECT_NEAR(100 * l.error[1], 17, 0.5);
    EXPECT_NEAR(100 * l.error[2], 4.1, 0.3);
}

TEST(Emps, LadderInTheAutomaticBand) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    expect_ladder(climb(read_capture(emps_csv()), {}), "automatic band");
}

TEST(Emps, LadderAt40Hz) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    expect_ladder(climb(read_capture(emps_csv()), 40), "40 Hz");
}

struct Published {
    const char* name;
    double value, within_percent, moves_percent;
};

constexpr Published published[] = {{"inertia", 95.1089, 0.5, -0.2},
                                   {"viscous.coefficient", 203.5034, 1.0, 2.1},
                                   {"coulomb.torque", 20.3935, 1.0, -1.5}};

TEST(Emps, PublishedProtocolGivesThePublishedValues) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const FitResult fit = climb(as_samples(read_capture(emps_csv())), 40).last;
    for (const Published& p : published) {
        const double v = value(fit, p.name);
        figure(fmt::format("EMPS, force as samples, {}", p.name), v, "",
               fmt::format("{} ± {} %", p.value, p.within_percent));
        EXPECT_NEAR(v, p.value, p.within_percent / 100 * p.value) << p.name;
    }
    EXPECT_NEAR(value(fit, "constant_torque.torque"), -3.1648, 3 * 0.0444);
}

TEST(Emps, HalfASampleOfHoldMovesThem) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture capture = read_capture(emps_csv());
    const FitResult held = climb(capture, 40).last, sampled = climb(as_samples(capture), 40).last;
    for (const Published& p : published) {
        const double moved = 100 * (value(held, p.name) / value(sampled, p.name) - 1);
        figure(fmt::format("EMPS, half a sample of hold moves {}", p.name), moved, "%",
               fmt::format("about {}", p.moves_percent));
        EXPECT_NEAR(moved, p.moves_percent, 0.3) << p.name;
    }
}

TEST(Emps, LoopViewIsWithinThePublishedError) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture capture = read_capture(emps_csv());
    const Ladder ladder = climb(capture, {});
    const Comparison c = compare(ladder.last.model, prepare_all({&capture, 1}, {}));
    ASSERT_TRUE(c.loop);
    figure("EMPS, closed loop, force error", 100 * c.loop->torque_error, "%", "at most 5.85");
    figure("EMPS, closed loop, position error", 100 * c.loop->position_error, "%",
           "published 0.0138");
    EXPECT_LE(c.loop->torque_error, 0.0585);
    EXPECT_LE(c.loop->position_error, 0.00014);
}

TEST(Emps, NoiseFloorAndRepeatableShare) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture capture = read_capture(emps_csv());
    const Comparison c = compare(climb(capture, {}).last.model, prepare_all({&capture, 1}, {}));
    figure("EMPS, noise floor", 100 * c.floor.ratio, "%", "about 0.6");
    figure("EMPS, repeatable share of the residual", 100 * c.floor.repeatable_share, "%",
           "about 97");
    EXPECT_TRUE(c.floor.from_repetition);
    EXPECT_EQ(c.floor.periods, 3);
    EXPECT_NEAR(100 * c.floor.ratio, 0.6, 0.1);
    EXPECT_NEAR(c.floor.repeatable_share, 0.97, 0.02);
}

// The .mat goes through a map whose scale is 1.4 ppm off.
TEST(Emps, MatGivesTheSame) {
    const std::string mat = data_folder() + "/emps/DATA_EMPS.mat";
    SERVOID_SKIP_WITHOUT(mat);
    const SignalMap map = read_signal_map(data_folder() + "/emps/emps_map.toml");
    const Ladder from_mat = climb(read_capture(mat, {}, &map), 40);
    const Ladder from_csv = climb(read_capture(emps_csv()), 40);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(from_mat.error[i], from_csv.error[i], 1e-5);
    for (const Published& p : published)
        EXPECT_NEAR(value(from_mat.last, p.name) / value(from_csv.last, p.name), 1, 1e-4) << p.name;
}

// The map may say that the force is a sample: `[metadata] torque_hold = "none"`.
TEST(Emps, MapCanSayThatTheForceIsASample) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    SignalMap map = read_signal_map(data_folder() + "/emps/emps_map.toml");
    map.metadata["torque_hold"] = "none";
    const Capture capture = read_capture(data_folder() + "/emps/DATA_EMPS.mat", {}, &map);
    EXPECT_FALSE(capture.ref_held);
}

TEST(Emps, FundamentalAloneAndWithTheModelsFriction) {
    SERVOID_SKIP_WITHOUT(emps_csv());
    const Capture capture = read_capture(emps_csv());
    const Model model = climb(capture, {}).last.model;
    IdentifyOptions options;
    const double plain = identify(capture, options).front().inertia.value;
    options.model = &model;
    const double cleaned = identify(capture, options).front().inertia.value;
    figure("EMPS, mass from the fundamental alone", plain, "kg", "22 % above 95.1: 116.6");
    figure("EMPS, mass with the model's Coulomb friction out", cleaned, "kg", "93 to 96");
    EXPECT_NEAR(plain, 116.6, 0.5);
    EXPECT_GT(cleaned, 93);
    EXPECT_LT(cleaned, 96);
}

} // namespace
