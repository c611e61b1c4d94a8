#include "common/text.hpp"
#include "effects/catalogue.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace servoid {

namespace {

// A TOML float: without a point or an exponent a large number would overflow a TOML integer.
std::string toml_number(double value) {
    std::string text = format_number(value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string toml_text(const std::string& text) {
    std::string escaped = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            escaped += {'\\', c};
        else if (byte < 0x20 || byte == 0x7f)
            escaped += fmt::format("\\u{:04x}", byte);
        else
            escaped += c;
    }
    return escaped + "\"";
}

// Lines of one table with their `=` below each other.
class TableText {
  public:
    explicit TableText(std::string heading) : heading_(std::move(heading)) {}
    void number(const std::string& key, double value) { raw(key, toml_number(value)); }
    void text(const std::string& key, const std::string& value) { raw(key, toml_text(value)); }
    void raw(const std::string& key, const std::string& value) { lines_.emplace_back(key, value); }
    void fixed(const std::vector<std::string>& keys) {
        if (keys.empty()) return;
        std::vector<std::string> quoted_keys;
        for (const auto& key : keys)
            quoted_keys.push_back(toml_text(key));
        raw("fixed", "[" + join(quoted_keys) + "]");
    }
    std::string str() const {
        size_t width = 0;
        for (const auto& [key, value] : lines_)
            width = std::max(width, key.size());
        std::string all = heading_.empty() ? "" : "\n" + heading_ + "\n";
        for (const auto& [key, value] : lines_)
            all += fmt::format("{:<{}} = {}\n", key, width, value);
        return all;
    }
    bool empty() const { return lines_.empty(); }

  private:
    std::string heading_;
    std::vector<std::pair<std::string, std::string>> lines_;
};

std::string controller_text(const Controller& controller) {
    const bool integrates = controller.type == Controller::Type::p_pi;
    TableText table("[controller]");
    table.text("type", integrates ? "p_pi" : "p_p");
    table.number("position_gain", controller.position_gain_per_s);
    table.number("speed_gain", controller.speed_gain);
    if (integrates) table.number("integral_time", controller.integral_time_s);
    table.number("sample_time", controller.sample_time_s);
    if (controller.speed_average != 1)
        table.raw("speed_average", std::to_string(controller.speed_average));
    return table.str();
}

// Whole where that gives exactly the same resolution; the division back and forth may be off by a
// last digit.
std::string counts_per_rev(double position_per_count) {
    const double turn = 2 * std::numbers::pi;
    const double counts = turn / position_per_count;
    const double whole = std::round(counts);
    const bool exact = whole < 1e15 && turn / whole == position_per_count;
    return exact ? fmt::format("{:.0f}", whole) : toml_number(counts);
}

std::string sensor_text(const Model& model) {
    const double resolution = model.sensor.position_per_count;
    if (resolution <= 0) return "";
    TableText table("[sensor]");
    if (model.motion == Motion::linear)
        table.number("metres_per_count", resolution);
    else
        table.raw("counts_per_rev", counts_per_rev(resolution));
    return table.str();
}

std::string drive_text(const Drive& drive) {
    TableText table("[drive]");
    if (drive.rated_torque > 0) table.number("rated_torque", drive.rated_torque);
    if (drive.torque_constant > 0) table.number("torque_constant", drive.torque_constant);
    if (drive.torque_limit > 0) table.number("torque_limit", drive.torque_limit);
    return table.empty() ? "" : table.str();
}

std::string custom_text(const EffectTerm& term, bool repeated) {
    const std::string name = "[effects." + term.name + "]";
    TableText table(repeated ? "[" + name + "]" : name);
    table.text("law", term.law);
    table.fixed(term.fixed);
    if (term.parameters.empty()) return table.str();
    TableText parameters("[effects." + term.name + ".parameters]");
    for (const auto& [key, value] : term.parameters)
        parameters.number(key, value);
    return table.str() + parameters.str();
}

std::string effect_text(const EffectTerm& term, bool repeated) {
    if (!term.law.empty()) return custom_text(term, repeated);
    const Effect* effect = find_effect(term.name);
    const bool repeatable = effect && effect->info().repeatable;
    TableText table(repeatable ? "[[effects." + term.name + "]]" : "[effects." + term.name + "]");
    // In the catalogue's order, which is the order of the law; the map would sort by name.
    if (effect)
        for (const auto& parameter : effect->parameters(term))
            if (term.parameters.contains(parameter.key))
                table.number(parameter.key, term.at(parameter.key));
    table.fixed(term.fixed);
    return table.str();
}

long count_of(const Model& model, const std::string& name) {
    return std::count_if(model.effects.begin(), model.effects.end(),
                         [&](const EffectTerm& term) { return term.name == name; });
}

} // namespace

std::string format_model(const Model& model) {
    TableText head("");
    if (!model.name.empty()) head.text("name", model.name);
    head.text("motion", model.motion == Motion::linear ? "linear" : "rotary");
    TableText plant("[plant]");
    plant.number("inertia", model.inertia);
    if (model.inertia_fixed) plant.fixed({"inertia"});
    std::string text = head.str() + plant.str();
    if (model.controller) text += controller_text(*model.controller);
    text += sensor_text(model) + drive_text(model.drive);
    for (const EffectTerm& term : model.effects)
        text += effect_text(term, count_of(model, term.name) > 1);
    return text;
}

} // namespace servoid
