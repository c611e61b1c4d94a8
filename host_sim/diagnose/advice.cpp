#include "diagnose/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace servoid {

namespace {

// Two effects that one kind of motion cannot tell apart, and the motion that can.
struct Pair {
    const char *one, *other, *record;
};

constexpr std::array kPairs = {
    Pair{"coulomb", "constant_torque", "the same move in both directions"},
    Pair{"torque_lag", "dead_time", "a sine or multisine that reaches higher frequencies"},
    Pair{"variable_inertia", "encoder_eccentricity",
         "full turns at constant high speed, and turns with strong acceleration at low speed"},
    Pair{"spring", "gravity", "a travel of more than half a turn"},
    Pair{"spring", "hard_stop", "a travel that ends earlier, and one that goes further"},
    Pair{"cogging", "periodic_disturbance", "the same move at half and at twice the speed"},
    Pair{"cogging", "torque_ripple", "the same slow move with and without a load"},
    Pair{"viscous", "quadratic_drag", "constant speeds up to twice the present top speed"},
    Pair{"stribeck", "presliding", "slow constant speeds, and small moves about standstill"},
    Pair{"backlash", "elastic_load", "the same multisine at a third of the amplitude"},
    Pair{"load_friction", "coulomb", "moves with several accelerations at the same speed"},
};

std::string separating(const std::string& a, const std::string& b) {
    for (const Pair& p : kPairs)
        if ((a == p.one && b == p.other) || (a == p.other && b == p.one)) return p.record;
    return "moves with other speeds, accelerations and travels";
}

std::string rivals_of(const Diagnosis& d) {
    std::string names;
    double none = 1;
    for (const Candidate& c : d.candidates) {
        none -= c.probability;
        if (c.probability > 0.05) names += (names.empty() ? "" : ", ") + c.effect;
    }
    return names + (none > 0.05 ? ", no further effect" : "");
}

// The move that was found; where none can do it within what the axis has shown, the one in words.
std::string record_next(const Diagnosis& d) {
    const std::string words = separating(d.candidates[0].effect, d.candidates[1].effect);
    if (!d.next) return "record " + words;
    if (d.next->separation < kWorthRecording)
        return fmt::format("no move within the recorded travel, speed and torque tells them apart "
                           "(at best {:.2g} times the noise); record {}",
                           d.next->separation, words);
    return fmt::format("record --experiment \"{}\" (they then differ by {:.2g} times the noise)",
                       d.next->experiment, d.next->separation);
}

} // namespace

std::string advice_for(const Diagnosis& d) {
    switch (d.verdict) {
    case Verdict::missing:
        return fmt::format("add {}: the torque error falls from {:.3g} % to {:.3g} % on data it "
                           "was not fitted to",
                           d.candidates[0].effect, 100 * d.validation_error_before,
                           100 * d.candidates[0].validation_error_after);
    case Verdict::ambiguous:
        if (!d.outside.empty())
            return fmt::format(
                "{} and a smooth law that has no name here explain the residual equally "
                "well; record {}",
                d.candidates[0].effect,
                d.candidates[0].effect == "hard_stop"
                    ? "a travel that goes further on either side"
                    : "constant speeds up to twice the present top speed");
        return fmt::format("{} explain the residual equally well; {}", rivals_of(d),
                           record_next(d));
    case Verdict::unknown:
        if (!d.outside.empty())
            return fmt::format("a smooth law that has no name here explains the residual better "
                               "than {}",
                               d.candidates[0].effect);
        if (!d.not_noise.empty())
            return fmt::format("nothing in the catalogue explains the residual, which {} and is no "
                               "function of position, velocity, acceleration or time; record the "
                               "same move several times, and everything else that happens then",
                               d.not_noise);
        return fmt::format("nothing in the catalogue explains the residual; a function of {} "
                           "explains {:.0f} % of what is left",
                           d.probes[0].name, 100 * d.probes[0].explained);
    case Verdict::adequate:
        if (d.error_before > 3 * d.noise_floor && !d.floor_from_repetition)
            return "the residual depends on nothing that was recorded, as noise does; the same "
                   "move "
                   "three times would tell how much of it is noise";
        return "the residual is noise: nothing more can be learnt from it";
    case Verdict::insufficient:
        break;
    }
    return d.shortage ? d.shortage->why + "; record instead: " + d.shortage->record
                      : "the capture cannot answer";
}

} // namespace servoid
