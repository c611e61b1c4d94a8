#include "answers/model_json.hpp"

#include "effects/catalogue.hpp"

#include <nlohmann/json.hpp>

#include <numbers>

namespace servoid {

namespace {

Json controller_json(const Controller& c) {
    Json out = {{"type", c.type == Controller::Type::p_pi ? "p_pi" : "p_p"},
                {"position_gain", c.position_gain_per_s},
                {"speed_gain", c.speed_gain}};
    if (c.type == Controller::Type::p_pi) out["integral_time"] = c.integral_time_s;
    out["sample_time"] = c.sample_time_s;
    if (c.speed_average != 1) out["speed_average"] = c.speed_average;
    return out;
}

Json drive_json(const Drive& d) {
    Json out = Json::object();
    if (d.rated_torque > 0) out["rated_torque"] = d.rated_torque;
    if (d.torque_constant > 0) out["torque_constant"] = d.torque_constant;
    if (d.torque_limit > 0) out["torque_limit"] = d.torque_limit;
    return out;
}

Json sensor_json(const Model& model) {
    const double step = model.sensor.position_per_count;
    if (model.motion == Motion::linear) return {{"metres_per_count", step}};
    return {{"counts_per_rev", 2 * std::numbers::pi / step}};
}

// Below custom, by name; an array where a name stands more than once.
void add_custom(Json& customs, const EffectTerm& term) {
    Json table = {{"law", term.law}};
    if (!term.fixed.empty()) table["fixed"] = term.fixed;
    table["parameters"] = Json::object();
    for (const auto& [key, value] : term.parameters)
        table["parameters"][key] = value;
    Json& place = customs[term.name.substr(term.name.find('.') + 1)];
    if (place.is_object()) place = Json::array({place});
    if (place.is_array())
        place.push_back(table);
    else
        place = table;
}

Json effects_json(const Model& model) {
    Json out = Json::object();
    for (const EffectTerm& term : model.effects) {
        if (!term.law.empty()) {
            add_custom(out["custom"], term);
            continue;
        }
        Json table = Json::object();
        for (const auto& [key, value] : term.parameters)
            table[key] = value;
        if (!term.fixed.empty()) table["fixed"] = term.fixed;
        const Effect* effect = find_effect(term.name);
        if (effect && effect->info().repeatable)
            out[term.name].push_back(table);
        else
            out[term.name] = table;
    }
    return out;
}

} // namespace

Json model_json(const Model& model) {
    Json out = Json::object();
    out["name"] = model.name;
    out["motion"] = model.motion == Motion::rotary ? "rotary" : "linear";
    out["plant"] = {{"inertia", model.inertia}};
    if (model.inertia_fixed) out["plant"]["fixed"] = {"inertia"};
    if (model.controller) out["controller"] = controller_json(*model.controller);
    if (model.sensor.position_per_count > 0) out["sensor"] = sensor_json(model);
    const Json drive = drive_json(model.drive);
    if (!drive.empty()) out["drive"] = drive;
    if (!model.effects.empty()) out["effects"] = effects_json(model);
    return out;
}

} // namespace servoid
