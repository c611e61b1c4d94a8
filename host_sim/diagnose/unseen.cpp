#include "diagnose/unseen.hpp"

#include "compare/one_way.hpp"
#include "diagnose/diagnose.hpp"
#include "effects/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace servoid {

namespace {

constexpr double kMayBeThere = 0.05; // of the torque's rms: two std of an amplitude that is open
constexpr double kFewCounts = 16;    // travel, in steps of the sensor
constexpr double kOneSpeed = 0.05;   // scatter of the speed over its mean
constexpr double kAboveFloor = 1.15; // error over the noise floor

struct Recipe {
    const char *effect, *record;
};

constexpr const char* kBothWays = "the same move in both directions";
constexpr const char* kTurns = "at least two full turns, slowly and at one more speed";
constexpr const char* kFaster = "a multisine or a sweep to higher frequencies";

constexpr std::array kRecipes = {
    Recipe{"coulomb", kBothWays},
    Recipe{"constant_torque", kBothWays},
    Recipe{"coulomb_asymmetric", kBothWays},
    Recipe{"viscous_asymmetric", "several speeds in both directions"},
    Recipe{"viscous", "several speeds"},
    Recipe{"quadratic_drag", "several speeds, up to the highest"},
    Recipe{"stribeck", "slow constant speeds, from a hundredth of the top speed"},
    Recipe{"presliding", "small moves about standstill, there and back"},
    Recipe{"load_friction", "several accelerations at the same speed"},
    Recipe{"gravity", kTurns},
    Recipe{"cogging", kTurns},
    Recipe{"torque_ripple", kTurns},
    Recipe{"encoder_eccentricity", "full turns at constant speed, and with acceleration"},
    Recipe{"variable_inertia", "full turns with strong acceleration"},
    Recipe{"spring", "a longer travel, at rest and moving"},
    Recipe{"hard_stop", "a travel up to the stops, slowly"},
    Recipe{"torque_gain", "nothing more: weigh or compute the inertia, and hold it with fixed"},
    Recipe{"torque_lag", kFaster},
    Recipe{"dead_time", kFaster},
    Recipe{"torque_saturation", "accelerations near the drive's limit"},
    Recipe{"elastic_load", kFaster},
    Recipe{"backlash", "slow reversals, and the same multisine at a third of the amplitude"},
    Recipe{"periodic_disturbance", "a longer record at another speed"},
    Recipe{"friction_drift", "the same move for some minutes"},
};

std::string record_for(const std::string& effect) {
    for (const Recipe& r : kRecipes)
        if (effect == r.effect) return r.record;
    return "moves with other speeds, accelerations and travels";
}

bool has_either(const Model& model, const std::string& effect) {
    return model.find(effect) || model.find(effect + "_asymmetric");
}

// Turns that a capture covers, at most; as many as one likes where no turns are known.
double turns_of(const std::vector<MotionView>& views) {
    double most = 0;
    for (const MotionView& view : views) {
        if (view.kind == Motion::linear || view.position.size() == 0) return INFINITY;
        most = std::max(most, view.travel() / (2 * std::numbers::pi));
    }
    return most;
}

// A kind of motion.
struct Kind {
    bool one_way = false, has_position = true;
    double turns = 0, band_Hz = 0;
};

// What it hides, whatever the fit says.
std::string hidden_by_motion(const std::string& effect, const Kind& kind) {
    const auto is = [&](std::initializer_list<const char*> names) {
        return std::find(names.begin(), names.end(), effect) != names.end();
    };
    if (kind.one_way && effect == "coulomb")
        return "one direction only: the same as constant_torque";
    if (kind.one_way && effect == "constant_torque")
        return "one direction only: the same as coulomb";
    if (kind.one_way && is({"coulomb_asymmetric", "viscous_asymmetric"}))
        return "one direction only";
    if (!kind.has_position &&
        is({"cogging", "torque_ripple", "encoder_eccentricity", "gravity", "variable_inertia",
            "hard_stop", "spring", "presliding", "backlash"}))
        return "the position was not recorded";
    if (kind.turns < 1 && is({"cogging", "encoder_eccentricity", "gravity"}))
        return "less than a full turn";
    if (effect == "elastic_load")
        return fmt::format("nothing above {:.3g} Hz is compared: no antiresonance there shows",
                           kind.band_Hz);
    if (effect == "torque_gain") return "the same as other inertia and friction together";
    return "";
}

// An amplitude that is not determined and may be as large as it likes.
bool may_be_large(const Candidate& c, double torque_rms) {
    if (c.parameters.empty() || c.note.find("not determined") == std::string::npos) return false;
    const FittedParameter& first = c.parameters.front();
    return first.quantity == Quantity::torque && !first.at_bound &&
           2 * first.estimate.std > kMayBeThere * torque_rms;
}

// "gravity cannot be seen: the move is too short; record instead: …" without its frame.
std::string reason_in(const Candidate& c) {
    std::string out = c.note.substr(0, c.note.find("; record instead: "));
    for (const std::string& frame : {c.effect + " cannot be seen: ", c.effect + " "})
        if (out.starts_with(frame)) return out.substr(frame.size());
    return out;
}

double rms_of(const Eigen::VectorXd& x) {
    return x.norm() / std::sqrt(double(std::max<Eigen::Index>(1, x.size())));
}

bool one_speed(const std::vector<PreparedMotion>& motions) {
    double sum = 0, square = 0, count = 0;
    for (const PreparedMotion& m : motions)
        for (Eigen::Index k = 0; k < m.velocity.size(); ++k) {
            if (!m.used[size_t(k)]) continue;
            const double speed = std::abs(m.velocity[k]);
            sum += speed, square += speed * speed, ++count;
        }
    const double mean = sum / std::max(1.0, count);
    return square / std::max(1.0, count) - mean * mean < std::pow(kOneSpeed * mean, 2);
}

bool few_counts(const std::vector<MotionView>& views) {
    return std::all_of(views.begin(), views.end(), [](const MotionView& view) {
        return view.position.size() && view.position_quantum > 0 &&
               view.travel() < kFewCounts * view.position_quantum;
    });
}

// Most effects refused or left open, and none of the others sound.
bool nothing_judged(const Diagnosis& d) {
    size_t open = 0;
    for (const Candidate& c : d.candidates) {
        if (c.sound) return false;
        open += !c.fitted || c.note.find("not determined") != std::string::npos;
    }
    return 2 * open > d.candidates.size() && d.error_before > kAboveFloor * d.noise_floor;
}

} // namespace

std::vector<Unseen> unseen_of(const Diagnosis& d, Assembler& assembler) {
    const std::vector<MotionView>& views = assembler.views();
    const bool has_position = std::any_of(
        views.begin(), views.end(), [](const MotionView& v) { return v.position.size() > 0; });
    const Kind kind{moves_one_way(assembler.motions()), has_position, turns_of(views), d.band_Hz};
    const double torque = rms_of(d.before.torque);
    std::vector<Unseen> out;
    for (const Candidate& c : d.candidates) {
        const bool alias = kind.one_way && (c.effect == "coulomb" || c.effect == "constant_torque");
        if (c.sound && !alias) continue;
        std::string why = hidden_by_motion(c.effect, kind);
        if (why.empty() && !c.fitted) why = reason_in(c);
        if (why.empty() && may_be_large(c, torque)) why = reason_in(c);
        if (!why.empty()) out.push_back({c.effect, why, record_for(c.effect)});
    }
    return out;
}

void share_aliases(Diagnosis& d, const std::vector<PreparedMotion>& motions) {
    if (!moves_one_way(motions)) return;
    Candidate *coulomb = nullptr, *constant = nullptr;
    for (Candidate& c : d.candidates) {
        if (c.effect == "coulomb") coulomb = &c;
        if (c.effect == "constant_torque") constant = &c;
    }
    const auto note = [](Candidate& c, const char* other) {
        c.note = fmt::format("the same as {} on one-way motion", other);
    };
    if (coulomb && d.before.model.find("constant_torque"))
        coulomb->sound = false, coulomb->probability = 0, note(*coulomb, "constant_torque");
    if (constant && has_either(d.before.model, "coulomb"))
        constant->sound = false, constant->probability = 0, note(*constant, "coulomb");
    if (coulomb && constant && coulomb->sound && constant->sound) {
        note(*coulomb, "constant_torque"), note(*constant, "coulomb");
        coulomb->probability = constant->probability =
            (coulomb->probability + constant->probability) / 2;
    }
    std::stable_sort(
        d.candidates.begin(), d.candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.probability > b.probability; });
}

std::optional<Unseen> shortage_of(const Diagnosis& d, Assembler& assembler) {
    const std::string all = "the axis";
    if (few_counts(assembler.views()))
        return Unseen{all, "the axis moves by a few counts of its encoder only",
                      "a periodic move in both directions, well above the encoder's resolution"};
    if (d.verdict == Verdict::missing || d.verdict == Verdict::ambiguous) return std::nullopt;
    if (one_speed(assembler.motions()))
        return Unseen{all,
                      "the axis moves at one constant speed only: neither inertia nor the "
                      "kind of friction shows",
                      "a move in both directions with several speeds and accelerations"};
    if (d.verdict == Verdict::unknown && nothing_judged(d))
        return Unseen{all, "no effect could be judged: this motion leaves most of them open",
                      "a move in both directions with several speeds and accelerations"};
    return std::nullopt;
}

} // namespace servoid
