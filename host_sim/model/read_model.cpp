#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"
#include "common/toml_view.hpp"
#include "model/effects_toml.hpp"
#include "model/model.hpp"

#include <numbers>

namespace servoid {

namespace {

Motion read_motion(const TomlView& root) {
    const std::string motion = root.text("motion");
    if (motion == "rotary") return Motion::rotary;
    if (motion == "linear") return Motion::linear;
    root.fail("motion", "motion is " + in_quotes(motion) + R"(; expected "rotary" or "linear")");
}

void read_plant(const TomlView& plant, Model& model) {
    plant.allow_only({"inertia", "fixed"});
    model.inertia = plant.positive("inertia");
    model.inertia_fixed = !read_fixed(plant, {"inertia"}).empty();
}

int read_speed_average(const TomlView& controller) {
    constexpr int longest_average = 4;
    if (!controller.has("speed_average")) return 1;
    const double value = controller.number("speed_average");
    if (value != static_cast<int>(value) || value < 1 || value > longest_average)
        controller.fail("speed_average",
                        "controller.speed_average must be a whole number from 1 to "
                        "4, not " +
                            format_number(value));
    return static_cast<int>(value);
}

Controller::Type read_type(const TomlView& table) {
    const std::string type = table.text("type");
    if (type == "p_pi") return Controller::Type::p_pi;
    if (type == "p_p") return Controller::Type::p_p;
    table.fail("type", "controller.type is " + in_quotes(type) + R"(; expected "p_pi" or "p_p")");
}

Controller read_controller(const TomlView& table) {
    table.allow_only(
        {"type", "position_gain", "speed_gain", "integral_time", "sample_time", "speed_average"});
    Controller controller;
    controller.type = read_type(table);
    controller.position_gain_per_s = table.positive("position_gain");
    controller.speed_gain = table.positive("speed_gain");
    controller.sample_time_s = table.positive("sample_time");
    controller.speed_average = read_speed_average(table);
    if (controller.type == Controller::Type::p_pi)
        controller.integral_time_s = table.positive("integral_time");
    else if (table.has("integral_time"))
        table.fail("integral_time", "controller.integral_time has no place in a p_p loop, which "
                                    "has no integrator; delete it or use type = \"p_pi\"");
    return controller;
}

Sensor read_sensor(const TomlView& table, Motion motion) {
    table.allow_only({"counts_per_rev", "metres_per_count"});
    const bool linear = motion == Motion::linear;
    const std::string wrong = linear ? "counts_per_rev" : "metres_per_count";
    if (table.has(wrong))
        table.fail(wrong, "sensor." + wrong + " is for a " + (linear ? "rotary" : "linear") +
                              " axis; expected " +
                              (linear ? "metres_per_count" : "counts_per_rev"));
    Sensor sensor;
    if (linear) sensor.position_per_count = table.positive_or("metres_per_count", 0);
    if (!linear && table.has("counts_per_rev"))
        sensor.position_per_count = 2 * std::numbers::pi / table.positive("counts_per_rev");
    return sensor;
}

Drive read_drive(const TomlView& table) {
    table.allow_only({"rated_torque", "torque_constant", "torque_limit"});
    Drive drive;
    drive.rated_torque = table.positive_or("rated_torque", 0);
    drive.torque_constant = table.positive_or("torque_constant", 0);
    drive.torque_limit = table.positive_or("torque_limit", 0);
    return drive;
}

} // namespace

Model parse_model(const std::string& toml_text, const std::string& name_for_messages) {
    if (trim(toml_text).empty())
        throw FileError(name_for_messages, 0, "is empty; a model was expected");
    const toml::table document = parse_toml(toml_text, name_for_messages);
    const TomlView root(document, name_for_messages, "");
    root.allow_only({"name", "motion", "plant", "controller", "sensor", "drive", "effects"});
    Model model;
    model.name = root.text_or("name", "");
    model.motion = read_motion(root);
    read_plant(root.table("plant"), model);
    if (root.has("controller")) model.controller = read_controller(root.table("controller"));
    if (root.has("sensor")) model.sensor = read_sensor(root.table("sensor"), model.motion);
    if (root.has("drive")) model.drive = read_drive(root.table("drive"));
    if (root.has("effects")) read_effects(root.table("effects"), model);
    return model;
}

Model read_model(const std::string& path) { return parse_model(read_file(path), path); }

} // namespace servoid
