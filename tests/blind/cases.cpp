#include "blind/cases.hpp"

#include "blind/draw_move.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLeastRatio = 3, kMostRatio = 30;     // of the noise
constexpr double kLeastShare = 0.01, kMostShare = 0.4; // of the torque
constexpr int kAttempts = 60;

using servoid::EffectTerm;

EffectTerm term(const std::string& name, std::map<std::string, double> parameters) {
    EffectTerm out;
    out.name = name;
    out.parameters = std::move(parameters);
    return out;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

std::string joined(const std::vector<std::string>& list) {
    std::string out;
    for (const std::string& s : list)
        out += (out.empty() ? "" : "+") + s;
    return out.empty() ? "nothing" : out;
}

// One attempt at a case: what was drawn so far.
struct Draft {
    System system;
    Drawn drawn;
    double amplitude = 1;
    Motion motion;
    std::vector<Plan> plans;
    World base; // the known part, true values
    std::vector<EffectTerm> known;
    double noise = 0;
    std::uint64_t noise_seed = 1;
    bool skips_first = false; // the recording starts in the second period
};

bool draw_axis(Draft& d, const std::vector<std::string>& effects, Random& random) {
    d.system = draw_system(random.pick(system_names()), random);
    for (const std::string& e : effects)
        if (!suits(e, d.system)) return false;
    const Excites what = excites(effects.empty() ? "nothing" : random.pick(effects));
    d.drawn = draw_move(what, d.system, random);
    d.amplitude = choose_amplitude(d.drawn, d.system, d.system.world);
    const Record r = run(d.system.world, d.drawn.move.sample(d.system.world.period, d.amplitude),
                         {.substeps = 10, .seed = 1});
    d.motion = motion_of(r, d.drawn.move, d.system.world.period);
    d.noise = random.chance(0.15) ? 0 : random.log_uniform(0.001, 0.02);
    d.noise_seed = random.word();
    // A move that hardly counts, or hardly breaks away, is nobody's experiment.
    const bool waits = d.drawn.move.top_Hz == 0; // dwells between its legs
    return d.motion.travel > 300 * d.system.world.quantum && !r.limited &&
           d.motion.stuck < (waits ? 0.5 : 0.15);
}

// What is in the world and in the model, before the hidden effect.
void draw_known(Draft& d, const std::vector<std::string>& effects, Random& random) {
    const bool constant = random.chance(0.3);
    const double size = 0.1 * d.motion.top_torque * random.uniform(-1, 1);
    d.base = d.system.world;
    d.base.torque_noise = d.noise * d.system.rated;
    std::vector<std::string> takes_out, forgets;
    for (const std::string& e : effects) {
        d.plans.push_back(draw_plan(e, d.system, d.motion, random));
        const Plan& p = d.plans.back();
        takes_out.insert(takes_out.end(), p.takes_out.begin(), p.takes_out.end());
        forgets.insert(forgets.end(), p.forgets.begin(), p.forgets.end());
    }
    const World& w = d.system.world;
    if (!contains(forgets, "viscous"))
        d.known.push_back(term("viscous", {{"coefficient", w.viscous_forward}}));
    else
        d.base.viscous_forward = d.base.viscous_reverse = 0;
    if (!contains(forgets, "coulomb"))
        d.known.push_back(term("coulomb", {{"torque", w.coulomb_forward}}));
    if (contains(forgets, "coulomb") || contains(takes_out, "coulomb"))
        d.base.coulomb_forward = d.base.coulomb_reverse = 0;
    if (constant && !contains(takes_out, "constant_torque")) {
        d.base.constant = size;
        d.known.push_back(term("constant_torque", {{"torque", size}}));
    }
    if (d.system.modes_known) {
        const Modes& m = *w.modes;
        d.known.push_back(
            term("elastic_load", {{"antiresonance_frequency", m.antiresonance / kTurn},
                                  {"resonance_frequency", m.resonance / kTurn},
                                  {"antiresonance_damping", m.antiresonance_damping},
                                  {"resonance_damping", m.resonance_damping}}));
    }
}

double band_of(const Draft& d) {
    if (d.drawn.move.top_Hz > 0) return std::max(30.0, 1.3 * d.drawn.move.top_Hz);
    return d.system.world.linear ? 50 : 100;
}

bool healthy(const Draft& d, const Record& r) {
    if (r.limited) return false;
    for (double x : r.position)
        if (!std::isfinite(x) || std::abs(x) > 10 * d.motion.travel) return false;
    return true;
}

// Experiments that repeat may be recorded from their second period on.
Record record(const Draft& d, const World& world, int substeps) {
    Move move = d.drawn.move;
    if (d.skips_first) move.duration_s += move.period_s;
    Record r = run(world, move.sample(world.period, d.amplitude),
                   {.substeps = substeps, .seed = d.noise_seed});
    if (!d.skips_first) return r;
    const auto drop = static_cast<long>(std::lround(move.period_s / world.period));
    for (auto* v : {&r.reference, &r.asked, &r.measured, &r.position, &r.velocity, &r.mean_velocity,
                    &r.acceleration, &r.direction, &r.delivered, &r.noise, &r.stuck})
        v->erase(v->begin(), v->begin() + drop);
    return r;
}

// Each effect of a pair is tuned without the other: beside it, a limit may hardly be met.
bool meets_its_limit(const World& world, const Record& r, const Strength& noise) {
    if (!(world.delivered_limit > 0)) return true;
    double cut = 0, asked = 0;
    for (double torque : r.asked) {
        cut += std::pow(std::max(0.0, std::abs(torque) - world.delivered_limit), 2);
        asked += torque * torque;
    }
    const double share = std::sqrt(cut / asked);
    return share >= 0.9 * kLeastShare && share >= kLeastRatio * noise.floor;
}

struct Tuned {
    EffectTerm hidden;
    Strength strength;
};

// A tool may look at a wider band: there, too, the effect is not most of the torque.
bool no_rattle(const Draft& d, const World& world, const servoid::Model& model, const Record& r) {
    return measure(world, d.base, model, r, 3 * band_of(d)).share < 0.45;
}

// The strength at which the effect leaves what is wanted of it; nothing where it cannot.
std::optional<Tuned> tune(const Draft& d, const Plan& plan, const servoid::Model& model,
                          Random& random) {
    const double wanted_ratio = random.log_uniform(kLeastRatio, kMostRatio);
    const double wanted_share = random.log_uniform(kLeastShare, kMostShare);
    if (!(plan.most > plan.least)) return {};
    double s = std::clamp(plan.start, plan.least, plan.most);
    for (int i = 0; i < 10; ++i) {
        World world = d.base;
        const EffectTerm hidden = plan.at(s);
        apply(world, hidden);
        const Record r = record(d, world, 10);
        if (!healthy(d, r)) return {};
        const Strength got = measure(world, d.base, model, r, band_of(d));
        if (!(got.share > 0)) return {};
        // Without torque noise the floor is far below what any effect leaves: the share decides.
        const double target = d.noise > 0
                                  ? std::clamp(wanted_ratio * got.floor, kLeastShare, kMostShare)
                                  : wanted_share;
        const bool strong = got.ratio() >= kLeastRatio && got.share >= 0.9 * kLeastShare;
        if (strong && got.share <= 1.1 * target && got.share >= target / 1.5)
            return no_rattle(d, world, model, r) ? std::optional(Tuned{hidden, got}) : std::nullopt;
        const double next = std::clamp(s * std::clamp(std::pow(target / got.share, 0.9), 0.1, 10.0),
                                       plan.least, plan.most);
        if (next == s) {
            if (strong && got.share <= kMostShare && no_rattle(d, world, model, r))
                return Tuned{hidden, got};
            return {};
        }
        s = next;
    }
    return {};
}

// Beliefs are a few per cent off; that is no missing effect.
void mislead(servoid::Model& m, Random& random) {
    m.inertia *= random.uniform(0.92, 1.08);
    for (EffectTerm& e : m.effects)
        for (auto& [key, value] : e.parameters) {
            const bool frequency = key.find("frequency") != std::string::npos;
            value *= frequency ? random.uniform(0.98, 1.02) : random.uniform(0.9, 1.1);
        }
}

servoid::Capture capture_of(const Draft& d, const Record& r, Random& random) {
    const double h = d.base.period;
    servoid::Capture c;
    c.path = "blind";
    for (size_t k = 0; k < r.size(); ++k)
        c.time_s.push_back(static_cast<double>(k) * h);
    c.position_ref = r.reference;
    c.torque_ref = r.asked;
    c.position = r.measured;
    c.sample_time_s = h;
    c.uniform = true;
    c.ref_held = true;
    c.linear = d.base.linear;
    c.position_quantum = d.base.quantum;
    c.metadata["sample_time_s"] = std::to_string(h);
    if (d.drawn.move.period_s > 0 && random.chance(0.5)) c.period_s = d.drawn.move.period_s;
    return c;
}

std::string in_words(const Draft& d) {
    std::ostringstream out;
    const Move& m = d.drawn.move;
    out << m.kind;
    if (m.top_Hz > 0) out << " to " << std::round(m.top_Hz) << " Hz";
    out << ", travel " << d.motion.travel << ", top speed " << d.motion.top_speed << ", "
        << m.duration_s << " s";
    if (m.period_s > 0) out << ", period " << m.period_s << " s";
    if (d.skips_first) out << ", from the second period";
    return out.str();
}

bool tied_to_time(const std::vector<std::string>& effects) {
    for (const char* name :
         {"friction_drift", "inertia_jump", "random_walk", "periodic_disturbance"})
        if (contains(effects, name)) return true;
    return false;
}

std::optional<Case> attempt(const std::vector<std::string>& effects, int seed, int number) {
    Random random(joined(effects), static_cast<std::uint64_t>(seed),
                  static_cast<std::uint64_t>(number));
    Draft d;
    if (!draw_axis(d, effects, random)) return {};
    d.skips_first = d.drawn.move.period_s > 0 && random.chance(0.4) && !tied_to_time(effects);
    draw_known(d, effects, random);
    Case out;
    out.known = believed(d.system, d.known);
    out.world = d.base;
    out.strength.share = 1e9;
    for (const Plan& plan : d.plans) {
        const auto tuned = tune(d, plan, out.known, random);
        if (!tuned) return {};
        out.hidden.push_back(tuned->hidden);
        apply(out.world, tuned->hidden);
        if (tuned->strength.share < out.strength.share) out.strength = tuned->strength;
    }
    out.base = d.base;
    out.record = record(d, out.world, 100);
    if (!healthy(d, out.record) || !meets_its_limit(out.world, out.record, out.strength)) return {};
    if (effects.empty())
        out.strength = measure(out.world, d.base, out.known, out.record, band_of(d));
    out.capture = capture_of(d, out.record, random);
    mislead(out.known, random);
    out.effects = effects;
    out.seed = seed, out.attempt = number;
    out.system = d.system;
    out.experiment = in_words(d);
    out.torque_noise = d.noise;
    out.has_coulomb = out.known.find("coulomb") != nullptr;
    out.has_viscous = out.known.find("viscous") != nullptr;
    out.has_constant = out.known.find("constant_torque") != nullptr;
    return out;
}

} // namespace

Case make_case(const std::vector<std::string>& effects, int seed) {
    for (int number = 0; number < kAttempts; ++number)
        if (auto made = attempt(effects, seed, number)) return std::move(*made);
    throw std::runtime_error("no experiment shows " + joined(effects) + ", seed " +
                             std::to_string(seed));
}

const std::vector<std::vector<std::string>>& pairs() {
    static const std::vector<std::vector<std::string>> all = {{"viscous", "coulomb"},
                                                              {"coulomb", "cogging"},
                                                              {"gravity", "viscous"},
                                                              {"torque_lag", "coulomb"},
                                                              {"stribeck", "constant_torque"},
                                                              {"elastic_load", "viscous"},
                                                              {"backlash", "constant_torque"},
                                                              {"torque_ripple", "constant_torque"},
                                                              {"load_friction", "viscous"},
                                                              {"spring", "coulomb"},
                                                              {"dead_time", "viscous"},
                                                              {"quadratic_drag", "cogging"},
                                                              {"periodic_disturbance", "coulomb"},
                                                              {"hard_stop", "viscous"},
                                                              {"friction_drift", "constant_torque"},
                                                              {"variable_inertia", "gravity"},
                                                              {"encoder_eccentricity", "cogging"},
                                                              {"torque_saturation", "viscous"},
                                                              {"viscous_asymmetric", "cogging"},
                                                              {"presliding", "constant_torque"}};
    return all;
}

} // namespace blind
