#include "diagnose/sanity.hpp"

#include "common/error.hpp"
#include "compare/compare.hpp"
#include "compare/homing_search.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/torque_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

constexpr double kReversed = 0.6; // error reversed over as recorded
constexpr double kMatters = 0.05; // error as recorded: less is no sign of anything
constexpr double kLate = 0.8;     // error shifted over as recorded, of a torque that is late
constexpr double kLateSamples = 1.25;
constexpr double kFarOff = 0.5;             // the same, of a torque that is early
constexpr double kLeastZ = 4, kFarOffZ = 3; // of the gain, from block to block
constexpr double kOverFloor = 4;            // power gained over the noise floor's
constexpr double kFilter_s = 3e-3;          // a measured current may be filtered for so long
constexpr double kShortest_s = 5e-3, kLongest_s = 0.02; // delay that a loop could survive

// Gain from reading the torque later or earlier, over its standard error from block to block.
double z_of(const TorqueMatch& match, const Match& before, const Match& after) {
    const std::vector<double> a = held_out_power(match.columns(), before.residual, match.blocks());
    const std::vector<double> b = held_out_power(match.columns(), after.residual, match.blocks());
    return gain_z(a, b);
}

// A quarter of a turn of phase where the loop's gain is one.
double longest_delay(const Model& model) {
    if (!model.controller || !(model.controller->speed_gain > 0)) return kLongest_s;
    const double survives = std::numbers::pi / 2 * model.inertia / model.controller->speed_gain;
    return std::clamp(survives, kShortest_s, kLongest_s);
}

double longest_sample(const std::vector<PreparedMotion>& motions) {
    double out = 0;
    for (const PreparedMotion& m : motions)
        out = std::max(out, m.capture->sample_time_s);
    return out;
}

Suspicion late(double delay_s, double sample_s, bool measured) {
    Suspicion out{Suspicion::Kind::shifted, "", "", true, delay_s};
    out.sentence = fmt::format("the torque comes {:.3g} ms ({:.3g} samples) after the motion it "
                               "causes: its column looks shifted",
                               -1e3 * delay_s, -delay_s / sample_s);
    out.remedy = "torque and position of the same instants, a row each";
    if (measured && -delay_s < kFilter_s) {
        out.refuses = false;
        out.sentence += " or filtered";
        out.remedy = "the torque unfiltered, or the one that the drive asks for (--input ref)";
    }
    return out;
}

Suspicion early(double delay_s, double sample_s) {
    return {Suspicion::Kind::shifted,
            fmt::format("the motion follows {:.3g} ms ({:.3g} samples) after its torque, more than "
                        "a loop survives: a column looks shifted",
                        1e3 * delay_s, delay_s / sample_s),
            "torque and position of the same instants, a row each", true, delay_s};
}

// Friction that turns late looks like a late torque; inertia is never late.
bool inertia_is_late(const TorqueMatch& match, double delay_s) {
    const std::optional<Estimate> inertia = match.delay_of_inertia();
    return !inertia || inertia->value < delay_s / 3;
}

std::optional<Suspicion> shift_of(const Model& model, const TorqueMatch& match, const Match& now,
                                  double delay_s, const Match& then, Assembler& assembler) {
    const std::vector<PreparedMotion>& motions = assembler.motions();
    const double sample_s = longest_sample(motions), ratio = then.error / now.error;
    const double least_z = ratio < kFarOff ? kFarOffZ : kLeastZ;
    if (!(ratio < kLate) || z_of(match, now, then) < least_z) return std::nullopt;
    const double gained = now.error * now.error - then.error * then.error;
    const double floor = noise_floor_of_all(model, motions).ratio;
    if (ratio > kFarOff && gained < kOverFloor * floor * floor) return std::nullopt;
    if (delay_s > longest_delay(model) && ratio < kFarOff) return early(delay_s, sample_s);
    const bool beyond_a_sample = delay_s < -kLateSamples * sample_s;
    if (!beyond_a_sample || (ratio > kFarOff && !inertia_is_late(match, delay_s)))
        return std::nullopt;
    return late(delay_s, sample_s, motions.front().input == Input::measured);
}

} // namespace

std::vector<Suspicion> capture_suspicions(const Model& believed, Assembler& assembler) {
    const TorqueMatch match(believed, assembler);
    const Match now = match.match({}), reversed = match.match({0, -1});
    if (!std::isfinite(now.error)) return {};
    const double delay_s = match.best_delay_s();
    const Match then = match.match({delay_s, 1});
    if (now.error > kMatters && reversed.error < kReversed * now.error &&
        reversed.error < then.error && reversed.inertia > 0)
        return {{Suspicion::Kind::reversed,
                 fmt::format("torque looks reversed: counted the other way round it leaves {:.3g} "
                             "% instead of {:.3g} %",
                             100 * reversed.error, 100 * now.error),
                 "torque that is positive where it speeds the axis up in positive direction", true,
                 -1}};
    const auto shift = shift_of(believed, match, now, delay_s, then, assembler);
    if (!shift) return {};
    return {*shift};
}

std::vector<Suspicion> suspicions(const Model& believed,
                                  const std::vector<PreparedMotion>& motions) {
    Assembler assembler(motions);
    home(believed, assembler);
    std::vector<Suspicion> out = capture_suspicions(believed, assembler);
    try {
        for (Suspicion& s : belief_suspicions(believed, fit(believed, assembler), assembler))
            out.push_back(std::move(s));
    } catch (const Refusal&) { // who asks for the fit is told
    }
    std::stable_partition(out.begin(), out.end(), [](const Suspicion& s) { return s.refuses; });
    return out;
}

std::vector<std::string> warnings_or_refusal(const std::vector<Suspicion>& found) {
    std::vector<std::string> out;
    for (const Suspicion& s : found) {
        if (s.refuses) throw Refusal(s.sentence, s.remedy);
        out.push_back(s.sentence + "; " + s.remedy);
    }
    return out;
}

} // namespace servoid
