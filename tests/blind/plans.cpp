#include "blind/plans.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using servoid::EffectTerm;

EffectTerm term(const std::string& name, std::map<std::string, double> parameters) {
    EffectTerm out;
    out.name = name;
    out.parameters = std::move(parameters);
    return out;
}

struct Draw {
    const System& system;
    const Motion& motion;
    Random& random;
    const World& world() const { return system.world; }
    double phase() const { return random.uniform(-std::numbers::pi, std::numbers::pi); }
    // Cycles per revolution or per metre whose frequency the motion keeps in reach, two in the
    // travel.
    double order(double most_Hz, int most = 36) const {
        const double fastest = most_Hz / motion.typical_speed; // cycles per rad or m
        const double slowest = 2 / motion.travel;
        const double unit = world().linear ? system.lead : kTurn;
        const int low = std::max(1, static_cast<int>(std::ceil(slowest * unit)));
        const int high = std::clamp(static_cast<int>(fastest * unit), low, std::max(low, most));
        const int n = random.integer(low, high);
        return world().linear ? n / system.lead : n;
    }
    double torque() const { return 0.2 * motion.top_torque; }
    double friction_speed() const { return motion.top_speed; }
};

Plan viscous(const Draw& d) {
    Plan p;
    p.forgets = {"viscous"};
    p.at = [](double s) { return term("viscous", {{"coefficient", s}}); };
    p.start = d.world().viscous_forward;
    return p;
}

Plan viscous_asymmetric(const Draw& d) {
    Plan p;
    const double base = d.world().viscous_forward, sign = d.random.sign();
    p.at = [=](double s) {
        return term("viscous_asymmetric", {{"coefficient_forward", base * (1 + sign * s)},
                                           {"coefficient_reverse", base * (1 - sign * s)}});
    };
    p.start = 0.3, p.most = 0.9;
    return p;
}

Plan coulomb(const Draw& d) {
    Plan p;
    p.forgets = {"coulomb"};
    p.at = [](double s) { return term("coulomb", {{"torque", s}}); };
    p.start = d.world().coulomb_forward;
    return p;
}

// Symmetric Coulomb friction is known; with a known constant torque nothing would be missing.
Plan coulomb_asymmetric(const Draw& d) {
    Plan p;
    const double base = d.world().coulomb_forward, sign = d.random.sign();
    if (d.random.chance(0.3)) p.forgets = {"coulomb"};
    p.takes_out = {"constant_torque"};
    p.at = [=](double s) {
        return term("coulomb_asymmetric", {{"torque_forward", base * (1 + sign * s)},
                                           {"torque_reverse", base * (1 - sign * s)}});
    };
    p.start = 0.3, p.most = 0.9;
    return p;
}

Plan stribeck(const Draw& d) {
    Plan p;
    const double speed = d.friction_speed() * d.random.log_uniform(0.04, 0.3);
    p.at = [=](double s) { return term("stribeck", {{"extra_torque", s}, {"velocity", speed}}); };
    p.start = 0.5 * d.world().coulomb_forward;
    p.most = 2 * d.world().coulomb_forward;
    return p;
}

// The bristles are the dry friction; some users believe in Coulomb's law instead.
Plan presliding(const Draw& d) {
    Plan p;
    const double length = d.motion.travel * d.random.log_uniform(0.01, 0.15);
    const bool believes_coulomb = d.random.chance(0.4);
    p.takes_out = {"coulomb"};
    if (!believes_coulomb) p.forgets = {"coulomb"};
    p.at = [=](double s) { return term("presliding", {{"stiffness", s / length}, {"torque", s}}); };
    p.start = d.world().coulomb_forward;
    return p;
}

Plan load_friction(const Draw&) {
    Plan p;
    p.at = [](double s) { return term("load_friction", {{"coefficient", s}}); };
    p.start = 0.1, p.most = 0.5;
    return p;
}

Plan quadratic_drag(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("quadratic_drag", {{"coefficient", s}}); };
    p.start = d.torque() / std::pow(d.motion.top_speed, 2);
    return p;
}

Plan constant_torque(const Draw& d) {
    Plan p;
    const double sign = d.random.sign();
    p.takes_out = {"constant_torque"};
    p.at = [=](double s) { return term("constant_torque", {{"torque", sign * s}}); };
    p.start = d.torque();
    return p;
}

Plan gravity(const Draw& d) {
    Plan p;
    const double phase = d.phase();
    p.at = [=](double s) { return term("gravity", {{"torque", s}, {"phase", phase}}); };
    p.start = d.torque();
    return p;
}

Plan spring(const Draw& d) {
    Plan p;
    const double rest = d.random.uniform(d.motion.lowest, d.motion.highest);
    p.at = [=](double s) { return term("spring", {{"stiffness", s}, {"rest_position", rest}}); };
    p.start = d.torque() / d.motion.travel;
    return p;
}

Plan hard_stop(const Draw& d) {
    Plan p;
    const double reach = std::max(std::abs(d.motion.lowest), std::abs(d.motion.highest));
    const double stop = reach * d.random.uniform(0.6, 0.95);
    p.at = [=](double s) { return term("hard_stop", {{"position", stop}, {"stiffness", s}}); };
    p.start = d.torque() / (0.1 * reach);
    return p;
}

Plan cogging(const Draw& d) {
    Plan p;
    const double order = std::max(d.world().linear ? 0.0 : 2.0, d.order(40)), phase = d.phase();
    p.at = [=](double s) {
        return term("cogging", {{"amplitude", s}, {"order", order}, {"phase", phase}});
    };
    p.start = d.torque();
    return p;
}

Plan torque_ripple(const Draw& d) {
    Plan p;
    const double order = d.order(40), phase = d.phase();
    p.at = [=](double s) {
        return term("torque_ripple", {{"fraction", s}, {"order", order}, {"phase", phase}});
    };
    p.start = 0.1, p.most = 0.6;
    return p;
}

Plan torque_lag(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("torque_lag", {{"time_constant", s}}); };
    p.start = 0.05 / d.system.band_Hz, p.least = 20e-6, p.most = 0.5 / d.system.band_Hz;
    return p;
}

Plan dead_time(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("dead_time", {{"delay", s}}); };
    p.start = 0.05 / d.system.band_Hz, p.least = 20e-6, p.most = 0.4 / d.system.band_Hz;
    return p;
}

// Strength: how much of the largest torque is cut.
Plan torque_saturation(const Draw& d) {
    Plan p;
    const double top = d.motion.top_torque;
    p.at = [=](double s) { return term("torque_saturation", {{"limit", top * (1 - s)}}); };
    p.start = 0.25, p.least = 0.03, p.most = 0.6;
    return p;
}

// Two masses with a spring: the dampings of both modes follow from one. Strength: 1/frequency.
Plan elastic_load(const Draw& d) {
    Plan p;
    const double ratio = d.random.uniform(1.15, 2.2), damping = d.random.log_uniform(0.01, 0.08);
    const double top = d.motion.top_Hz > 0 ? d.motion.top_Hz : d.system.band_Hz / 2;
    p.at = [=](double s) {
        return term("elastic_load", {{"antiresonance_frequency", top / s},
                                     {"resonance_frequency", top * ratio / s},
                                     {"antiresonance_damping", damping},
                                     {"resonance_damping", damping * ratio}});
    };
    p.start = d.random.uniform(0.8, 2), p.least = 0.3, p.most = 2.5;
    return p;
}

Plan backlash(const Draw& d) {
    Plan p;
    const double share = d.random.uniform(0.3, 0.85);
    p.at = [=](double s) { return term("backlash", {{"gap", s}, {"load_share", share}}); };
    p.start = 0.02 * d.motion.travel, p.most = 0.3 * d.motion.travel;
    return p;
}

Plan variable_inertia(const Draw& d) {
    Plan p;
    const double order = d.order(20, 4), phase = d.phase();
    p.at = [=](double s) {
        return term("variable_inertia", {{"fraction", s}, {"order", order}, {"phase", phase}});
    };
    p.start = 0.1;
    p.most = order > 4 ? 0 : 0.6; // a short move that would need a finer wave shows none
    return p;
}

Plan encoder_eccentricity(const Draw& d) {
    Plan p;
    const double phase = d.phase();
    p.at = [=](double s) {
        return term("encoder_eccentricity", {{"amplitude", s}, {"phase", phase}});
    };
    p.start = 0.01, p.most = 0.05;
    return p;
}

Plan periodic_disturbance(const Draw& d) {
    Plan p;
    const double f = d.random.log_uniform(std::max(1.0, 4 / d.motion.duration_s), 45);
    const double phase = d.phase();
    p.at = [=](double s) {
        return term("periodic_disturbance", {{"amplitude", s}, {"frequency", f}, {"phase", phase}});
    };
    p.start = d.torque();
    return p;
}

Plan friction_drift(const Draw& d) {
    Plan p;
    const double tau = d.motion.duration_s * d.random.log_uniform(0.1, 0.7);
    const double sign = d.random.sign();
    p.at = [=](double s) {
        return term("friction_drift", {{"fraction", sign * s}, {"time_constant", tau}});
    };
    p.start = 0.3, p.most = sign > 0 ? 1.5 : 0.8;
    return p;
}

// --- in no catalogue -------------------------------------------------------------------------

Plan cubic_spring(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("cubic_spring", {{"stiffness", s}}); };
    p.start = d.torque() / std::pow(std::max(d.motion.highest, -d.motion.lowest), 3);
    return p;
}

Plan cubic_drag(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("cubic_drag", {{"coefficient", s}}); };
    p.start = d.torque() / std::pow(d.motion.top_speed, 3);
    return p;
}

Plan random_walk(const Draw& d) {
    Plan p;
    p.at = [](double s) { return term("random_walk", {{"torque_per_root_s", s}}); };
    p.start = d.torque();
    return p;
}

Plan inertia_jump(const Draw& d) {
    Plan p;
    const double t = d.motion.duration_s * d.random.uniform(0.3, 0.7);
    p.at = [=](double s) { return term("inertia_jump", {{"time", t}, {"factor", 1 + s}}); };
    p.start = 0.3, p.most = 1;
    return p;
}

struct Row {
    Excites excites;
    Plan (*draw)(const Draw&);
};

const std::map<std::string, Row>& rows() {
    using enum Excites;
    static const std::map<std::string, Row> all = {
        {"viscous", {friction, viscous}},
        {"viscous_asymmetric", {friction, viscous_asymmetric}},
        {"coulomb", {friction, coulomb}},
        {"coulomb_asymmetric", {friction, coulomb_asymmetric}},
        {"stribeck", {friction, stribeck}},
        {"presliding", {friction, presliding}},
        {"load_friction", {friction, load_friction}},
        {"quadratic_drag", {friction, quadratic_drag}},
        {"constant_torque", {anything, constant_torque}},
        {"gravity", {position, gravity}},
        {"spring", {anything, spring}},
        {"hard_stop", {anything, hard_stop}},
        {"cogging", {position, cogging}},
        {"torque_ripple", {position, torque_ripple}},
        {"torque_lag", {dynamics, torque_lag}},
        {"dead_time", {dynamics, dead_time}},
        {"torque_saturation", {dynamics, torque_saturation}},
        {"elastic_load", {dynamics, elastic_load}},
        {"backlash", {dynamics, backlash}},
        {"variable_inertia", {position, variable_inertia}},
        {"encoder_eccentricity", {position, encoder_eccentricity}},
        {"periodic_disturbance", {anything, periodic_disturbance}},
        {"friction_drift", {friction, friction_drift}},
        {"cubic_spring", {anything, cubic_spring}},
        {"cubic_drag", {friction, cubic_drag}},
        {"random_walk", {anything, random_walk}},
        {"inertia_jump", {dynamics, inertia_jump}},
        {"nothing", {anything, nullptr}},
    };
    return all;
}

} // namespace

Excites excites(const std::string& effect) { return rows().at(effect).excites; }

bool suits(const std::string& effect, const System& system) {
    if (system.world.linear)
        return effect != "gravity" && effect != "encoder_eccentricity" &&
               effect != "variable_inertia";
    // A modal load has no place for a second gap spring beside a rigid contact.
    return effect != "elastic_load" || !system.modes_known;
}

Plan draw_plan(const std::string& effect, const System& system, const Motion& motion,
               Random& random) {
    Plan plan = rows().at(effect).draw({system, motion, random});
    plan.effect = effect;
    return plan;
}

const std::vector<std::string>& hidden_effects() {
    static const std::vector<std::string> all = {"viscous",
                                                 "viscous_asymmetric",
                                                 "coulomb",
                                                 "coulomb_asymmetric",
                                                 "stribeck",
                                                 "presliding",
                                                 "load_friction",
                                                 "quadratic_drag",
                                                 "constant_torque",
                                                 "gravity",
                                                 "spring",
                                                 "hard_stop",
                                                 "cogging",
                                                 "torque_ripple",
                                                 "torque_lag",
                                                 "dead_time",
                                                 "torque_saturation",
                                                 "elastic_load",
                                                 "backlash",
                                                 "variable_inertia",
                                                 "encoder_eccentricity",
                                                 "periodic_disturbance",
                                                 "friction_drift"};
    return all;
}

const std::vector<std::string>& foreign_effects() {
    static const std::vector<std::string> all = {"cubic_spring", "cubic_drag", "random_walk",
                                                 "inertia_jump"};
    return all;
}

} // namespace blind
