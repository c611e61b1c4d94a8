// What each name of the catalogue means in the world.
#include "blind/world.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using servoid::EffectTerm;
using Writer = std::function<void(World&, const EffectTerm&)>;

// Orders are per revolution of a rotary axis and per metre of a linear one.
Wave wave_of(const World& w, const EffectTerm& e, const char* amplitude) {
    return {e.at(amplitude), e.at("order") * (w.linear ? kTurn : 1), e.at("phase")};
}

Modes modes_of(const EffectTerm& e) {
    return {kTurn * e.at("antiresonance_frequency"), kTurn * e.at("resonance_frequency"),
            e.at("antiresonance_damping"), e.at("resonance_damping")};
}

const std::map<std::string, Writer>& writers() {
    static const std::map<std::string, Writer> all = {
        {"viscous",
         [](World& w, const EffectTerm& e) {
             w.viscous_forward = w.viscous_reverse = e.at("coefficient");
         }},
        {"viscous_asymmetric",
         [](World& w, const EffectTerm& e) {
             w.viscous_forward = e.at("coefficient_forward");
             w.viscous_reverse = e.at("coefficient_reverse");
         }},
        {"coulomb",
         [](World& w, const EffectTerm& e) {
             w.coulomb_forward = w.coulomb_reverse = e.at("torque");
         }},
        {"coulomb_asymmetric",
         [](World& w, const EffectTerm& e) {
             w.coulomb_forward = e.at("torque_forward");
             w.coulomb_reverse = e.at("torque_reverse");
         }},
        {"stribeck",
         [](World& w, const EffectTerm& e) {
             w.stribeck_extra = e.at("extra_torque");
             w.stribeck_velocity = e.at("velocity");
         }},
        {"presliding",
         [](World& w, const EffectTerm& e) {
             w.bristle_stiffness = e.at("stiffness");
             w.bristle_torque = e.at("torque");
         }},
        {"load_friction",
         [](World& w, const EffectTerm& e) { w.load_friction = e.at("coefficient"); }},
        {"quadratic_drag",
         [](World& w, const EffectTerm& e) { w.quadratic = e.at("coefficient"); }},
        {"constant_torque", [](World& w, const EffectTerm& e) { w.constant = e.at("torque"); }},
        {"gravity",
         [](World& w, const EffectTerm& e) {
             w.gravity = e.at("torque");
             w.gravity_phase = e.at("phase");
         }},
        {"spring",
         [](World& w, const EffectTerm& e) {
             w.spring = e.at("stiffness");
             w.spring_rest = e.at("rest_position");
         }},
        {"hard_stop",
         [](World& w, const EffectTerm& e) {
             w.stop_position = e.at("position");
             w.stop_stiffness = e.at("stiffness");
         }},
        {"cogging",
         [](World& w, const EffectTerm& e) { w.cogging.push_back(wave_of(w, e, "amplitude")); }},
        {"torque_ripple",
         [](World& w, const EffectTerm& e) { w.ripple.push_back(wave_of(w, e, "fraction")); }},
        {"torque_lag", [](World& w, const EffectTerm& e) { w.lag = e.at("time_constant"); }},
        {"dead_time", [](World& w, const EffectTerm& e) { w.dead_time = e.at("delay"); }},
        {"torque_saturation",
         [](World& w, const EffectTerm& e) { w.delivered_limit = e.at("limit"); }},
        {"elastic_load", [](World& w, const EffectTerm& e) { w.modes = modes_of(e); }},
        {"backlash",
         [](World& w, const EffectTerm& e) {
             w.gap = e.at("gap");
             w.load_share = e.at("load_share");
             if (!w.modes) return; // the contact stays as stiff as it is
             const double ratio = w.modes->antiresonance / w.modes->resonance;
             w.load_share = 1 - ratio * ratio;
             w.contact_rad_s = w.modes->antiresonance;
             w.contact_damping = w.modes->antiresonance_damping;
         }},
        {"variable_inertia",
         [](World& w, const EffectTerm& e) { w.inertia_wave = wave_of(w, e, "fraction"); }},
        {"encoder_eccentricity",
         [](World& w, const EffectTerm& e) {
             w.eccentricity = e.at("amplitude");
             w.eccentricity_phase = e.at("phase");
         }},
        {"periodic_disturbance",
         [](World& w, const EffectTerm& e) {
             w.disturbance = e.at("amplitude");
             w.disturbance_Hz = e.at("frequency");
             w.disturbance_phase = e.at("phase");
         }},
        {"friction_drift",
         [](World& w, const EffectTerm& e) {
             w.drift = e.at("fraction");
             w.drift_time = e.at("time_constant");
         }},
        // In no catalogue:
        {"cubic_spring", [](World& w, const EffectTerm& e) { w.cubic_spring = e.at("stiffness"); }},
        {"cubic_drag", [](World& w, const EffectTerm& e) { w.cubic_drag = e.at("coefficient"); }},
        {"random_walk",
         [](World& w, const EffectTerm& e) { w.walk_per_root_s = e.at("torque_per_root_s"); }},
        {"inertia_jump",
         [](World& w, const EffectTerm& e) {
             w.jump_time = e.at("time");
             w.jump_factor = e.at("factor");
         }},
    };
    return all;
}

} // namespace

void apply(World& world, const EffectTerm& effect) {
    const auto found = writers().find(effect.name);
    if (found == writers().end()) throw std::invalid_argument("no such effect: " + effect.name);
    found->second(world, effect);
}

} // namespace blind
