// What the user believes: an axis, its inertia, the loop that drives it, and a list of effects.
// Read from and written to TOML (SPEC.md, "Model"). Plain data; all numbers SI.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace servoid {

enum class Motion { rotary, linear };

// Position P, speed PI (paper, Fig. 2 and eq. (16)); `p_p` has no integrator.
struct Controller {
    enum class Type { p_pi, p_p };
    Type type = Type::p_pi;
    double position_gain_per_s = 0;
    double speed_gain = 0;      // N·m·s/rad or N·s/m
    double integral_time_s = 0; // 0 for p_p
    double sample_time_s = 0;
    int speed_average =
        1; // positions averaged before the speed is differenced (1: plain difference)
};

struct Sensor {
    // Resolution of the position: rad or m per count; 0 where the model does not say.
    double position_per_count = 0;
};

struct Drive {
    double rated_torque = 0;    // N·m or N; 0 where the model does not say
    double torque_constant = 0; // N·m or N per A; 0 where the model does not say
    double torque_limit = 0;    // N·m or N, 0: no limit known
};

// One effect of the catalogue (host_sim/effects) with the values of this model.
struct EffectTerm {
    std::string name;                         // "viscous", "cogging", "custom.<name>"
    std::map<std::string, double> parameters; // every parameter of the effect, by key
    std::vector<std::string> fixed;           // keys that no fit may change
    std::string law;                          // custom effects only
    bool is_fixed(const std::string& key) const;
    double at(const std::string& key) const; // throws std::out_of_range on a key that is not there
};

struct Model {
    std::string name;
    Motion motion = Motion::rotary;
    double inertia = 0; // kg·m² or kg, total, motor side
    bool inertia_fixed = false;
    std::optional<Controller> controller;
    Sensor sensor;
    Drive drive;
    std::vector<EffectTerm> effects;

    const EffectTerm* find(const std::string& effect) const; // first of that name, or nullptr
};

// Reads a model file. Unknown keys, missing keys, wrong types, values outside the catalogue's
// bounds and combinations that make no sense raise FileError with the line.
Model read_model(const std::string& path);
Model parse_model(const std::string& toml_text, const std::string& name_for_messages);

// Writes so that read_model gives the same numbers back (17 significant digits where needed).
std::string format_model(const Model& model);

} // namespace servoid
