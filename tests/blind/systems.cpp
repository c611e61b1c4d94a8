#include "blind/systems.hpp"

#include <cmath>
#include <numbers>

namespace blind {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kMotorInertia = 0.116e-4;

void set_rotary_loop(World& w, double speed_gain) {
    w.position_gain = 40;
    w.speed_gain = speed_gain;
    w.integral_time = 4 / (40 * kTurn);
    w.period = 125e-6;
}

// Tables I and II of the paper.
System system_1() {
    System s;
    s.world.inertia = kMotorInertia;
    s.world.viscous_forward = 0.75e-4;
    s.world.coulomb_forward = 6.6e-3;
    set_rotary_loop(s.world, 40 * kTurn * kMotorInertia);
    s.rated = 0.637, s.speed = 100, s.acceleration = 5000, s.band_Hz = 200;
    return s;
}

System system_2(bool elastic, Random& random) {
    System s;
    s.world.inertia = 0.556e-4;
    s.world.viscous_forward = random.chance(0.5) ? 0.96e-3 : 0.96e-4;
    s.world.coulomb_forward = 2.1e-2;
    set_rotary_loop(s.world, 40 * kTurn * kMotorInertia * random.uniform(1, 2.5));
    if (elastic) s.world.modes = Modes{kTurn * 402.3, kTurn * 628.9, 0.05, 0.05};
    s.modes_known = elastic;
    s.rated = 0.637, s.speed = 70, s.acceleration = 3000, s.band_Hz = 200;
    return s;
}

System slide(Random& random) {
    System s;
    s.world.linear = true;
    s.world.inertia = 20;
    s.world.viscous_forward = 150;
    s.world.coulomb_forward = 30;
    s.world.position_gain = 40;
    s.world.speed_gain = kTurn * 30 * 20;
    s.world.integral_time = 4 / (kTurn * 30);
    s.world.period = random.chance(0.5) ? 250e-6 : 125e-6;
    s.lead = 5e-3, s.rated = 500, s.speed = 0.3, s.acceleration = 6, s.band_Hz = 120;
    return s;
}

// Like EMPS: position P, speed P, a millisecond.
System heavy_slide() {
    System s;
    s.world.linear = true;
    s.world.inertia = 95;
    s.world.viscous_forward = 200;
    s.world.coulomb_forward = 20;
    s.world.position_gain = 80;
    s.world.speed_gain = 8557;
    s.world.period = 1e-3;
    s.lead = 5e-3, s.rated = 200, s.speed = 0.15, s.acceleration = 1.5, s.band_Hz = 50;
    return s;
}

} // namespace

const std::vector<std::string>& system_names() {
    static const std::vector<std::string> names = {"system 1", "system 2 rigid", "system 2 elastic",
                                                   "slide", "heavy slide"};
    return names;
}

System draw_system(const std::string& name, Random& random) {
    System s = name == "system 1"           ? system_1()
               : name == "system 2 rigid"   ? system_2(false, random)
               : name == "system 2 elastic" ? system_2(true, random)
               : name == "slide"            ? slide(random)
                                            : heavy_slide();
    s.name = name;
    World& w = s.world;
    w.inertia *= random.uniform(0.9, 1.3);
    w.viscous_forward *= random.log_uniform(0.6, 1.6);
    w.coulomb_forward *= random.log_uniform(0.6, 1.6);
    w.viscous_reverse = w.viscous_forward, w.coulomb_reverse = w.coulomb_forward;
    s.bits = random.integer(15, 20);
    w.quantum = (w.linear ? s.lead : kTurn) / std::pow(2.0, s.bits);
    w.torque_limit = 3 * s.rated;
    w.contact_rad_s = kTurn * random.log_uniform(1000, 2500);
    w.contact_damping = random.uniform(0.4, 1.0);
    return s;
}

servoid::Model believed(const System& system, const std::vector<servoid::EffectTerm>& effects) {
    const World& w = system.world;
    servoid::Model m;
    m.name = system.name;
    m.motion = w.linear ? servoid::Motion::linear : servoid::Motion::rotary;
    m.inertia = w.inertia;
    servoid::Controller c;
    c.type = w.integral_time > 0 ? servoid::Controller::Type::p_pi : servoid::Controller::Type::p_p;
    c.position_gain_per_s = w.position_gain;
    c.speed_gain = w.speed_gain;
    c.integral_time_s = w.integral_time;
    c.sample_time_s = w.period;
    m.controller = c;
    m.sensor.position_per_count = w.quantum;
    m.drive.rated_torque = system.rated;
    m.drive.torque_limit = w.torque_limit;
    m.effects = effects;
    return m;
}

} // namespace blind
