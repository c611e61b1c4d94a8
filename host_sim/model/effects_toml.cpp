#include "model/effects_toml.hpp"

#include "common/error.hpp"
#include "common/text.hpp"
#include "effects/catalogue.hpp"
#include "effects/law.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace servoid {

namespace {

constexpr const char* custom_name = "custom";

// One effect as it stands in the file.
struct FoundTerm {
    TomlView table;
    const Effect* effect;
    EffectTerm term;
};

std::vector<std::string> catalogue_names() {
    std::vector<std::string> names;
    for (const Effect* effect : catalogue())
        names.push_back(effect->info().name);
    return names;
}

void check_bounds(const TomlView& table, const ParameterInfo& parameter, double value) {
    if (value >= parameter.lower && value <= parameter.upper) return;
    std::string allowed = std::isfinite(parameter.lower)
                              ? "at least " + format_number(parameter.lower)
                              : "at most " + format_number(parameter.upper);
    if (std::isfinite(parameter.lower) && std::isfinite(parameter.upper))
        allowed = format_number(parameter.lower) + " to " + format_number(parameter.upper);
    table.fail(parameter.key, table.full(parameter.key) + " = " + format_number(value) +
                                  " is out of bounds; expected " + allowed);
}

// `period` says on a linear axis what `order` says: one of them.
void check_period(const TomlView& table, Motion motion) {
    if (motion != Motion::linear)
        table.fail("period", table.full("period") + " is for a linear axis; expected order, in "
                                                    "cycles per revolution");
    if (table.has("order"))
        table.fail("order", table.full("order") + " and period say the same; keep one of them");
}

// The parameters that a table of this effect shall have: an effect may look at those it has.
std::vector<ParameterInfo> expected_in(const TomlView& table, const Effect& effect) {
    EffectTerm as_it_stands;
    for (const auto& key : table.keys())
        as_it_stands.parameters[key] = 0;
    return effect.parameters(as_it_stands);
}

EffectTerm read_term(const TomlView& table, const Effect& effect, Motion motion) {
    const std::vector<ParameterInfo> expected = expected_in(table, effect);
    std::vector<std::string> keys;
    for (const auto& parameter : expected)
        keys.push_back(parameter.key);
    if (std::find(keys.begin(), keys.end(), "period") != keys.end()) check_period(table, motion);
    auto known = keys;
    known.emplace_back("fixed");
    table.allow_only(known);

    EffectTerm term;
    term.name = effect.info().name;
    for (const auto& parameter : expected) {
        const double value = table.number(parameter.key);
        check_bounds(table, parameter, value);
        term.parameters[parameter.key] = value;
    }
    term.fixed = read_fixed(table, keys);
    return term;
}

[[noreturn]] void fail_for(const TomlView& custom, const LawFault& fault) {
    if (fault.parameter.empty()) custom.fail("law", custom.full("law") + ": " + fault.reason);
    const TomlView parameters = custom.table("parameters");
    parameters.fail(fault.parameter, "[" + parameters.path() + "]: " + fault.reason);
}

EffectTerm read_custom(const TomlView& table, const std::string& name) {
    table.allow_only({"law", "parameters", "fixed"});
    EffectTerm term;
    term.name = std::string(custom_name) + "." + name;
    term.law = table.text("law");
    std::vector<std::string> keys;
    if (table.has("parameters")) {
        const TomlView parameters = table.table("parameters");
        keys = parameters.keys();
        for (const auto& key : keys)
            term.parameters[key] = parameters.number(key);
    }
    term.fixed = read_fixed(table, keys);
    if (const auto fault = find_fault(term.law, keys)) fail_for(table, *fault);
    return term;
}

// The tables of an array [[...]] below `parent`.
std::vector<TomlView> tables_of(const TomlView& parent, const std::string& name) {
    std::vector<TomlView> out;
    for (const auto& element : *parent.raw().get(name)->as_array()) {
        if (!element.is_table())
            parent.fail(name, parent.full(name) + " must hold tables, not " + kind_of(element));
        out.emplace_back(*element.as_table(), parent.file(), parent.full(name));
    }
    return out;
}

void read_customs(const TomlView& customs, const Effect* effect, std::vector<FoundTerm>& found) {
    for (const auto& name : customs.keys()) {
        if (name == "law" || name == "parameters" || name == "fixed")
            customs.fail(name, "[" + customs.path() + "] holds laws by name; expected [" +
                                   customs.full("NAME") + "] with " + in_quotes(name) + " in it");
        if (const std::string why = fault_of_name(name); !why.empty()) customs.fail(name, why);
        const bool array = customs.raw().get(name)->is_array();
        for (const TomlView& table :
             array ? tables_of(customs, name) : std::vector{customs.table(name)})
            found.push_back({table, effect, read_custom(table, name)});
    }
}

void read_array(const TomlView& effects, const Effect* effect, Motion motion,
                std::vector<FoundTerm>& found) {
    const std::string& name = effect->info().name;
    if (!effect->info().repeatable)
        effects.fail(name, "[[" + effects.full(name) + "]]: " + name +
                               " can be in a model only once; write it as a table [" +
                               effects.full(name) + "]");
    for (const TomlView& table : tables_of(effects, name))
        found.push_back({table, effect, read_term(table, *effect, motion)});
}

void read_one(const TomlView& effects, const std::string& name, Motion motion,
              std::vector<FoundTerm>& found) {
    const Effect* effect = find_effect(name);
    if (!effect || effect->info().name != name) // "custom.x" in quotes is one key
        effects.fail(name,
                     "unknown effect " + in_quotes(name) + suggestion(name, catalogue_names()));
    if (name == custom_name) return read_customs(effects.table(name), effect, found);
    if (effects.raw().get(name)->is_array()) return read_array(effects, effect, motion, found);
    const TomlView table = effects.table(name);
    found.push_back({table, effect, read_term(table, *effect, motion)});
}

// Whether the terms may stand together; each is asked as if it were added last.
void check_together(const std::vector<FoundTerm>& found, const Model& model) {
    for (size_t i = 0; i < found.size(); ++i) {
        Model others = model;
        others.effects.erase(others.effects.begin() + static_cast<std::ptrdiff_t>(i));
        const std::string reason = cannot_add(*found[i].effect, others);
        if (!reason.empty())
            found[i].table.fail("[" + found[i].table.path() +
                                "] cannot be in this model: " + reason);
    }
}

} // namespace

std::vector<std::string> read_fixed(const TomlView& table,
                                    const std::vector<std::string>& parameters) {
    const auto fixed = table.texts("fixed");
    std::set<std::string> seen;
    for (const auto& key : fixed) {
        if (std::find(parameters.begin(), parameters.end(), key) == parameters.end())
            table.fail("fixed", table.full("fixed") + " names " + in_quotes(key) +
                                    ", which is no parameter here" + suggestion(key, parameters));
        if (!seen.insert(key).second)
            table.fail("fixed", table.full("fixed") + " names " + in_quotes(key) + " twice");
    }
    return fixed;
}

void read_effects(const TomlView& effects, Model& model) {
    std::vector<FoundTerm> found;
    for (const auto& name : effects.keys())
        read_one(effects, name, model.motion, found);
    std::stable_sort(found.begin(), found.end(), [](const FoundTerm& a, const FoundTerm& b) {
        return a.table.raw().source().begin < b.table.raw().source().begin;
    });
    for (const auto& entry : found)
        model.effects.push_back(entry.term);
    check_together(found, model);
}

} // namespace servoid
