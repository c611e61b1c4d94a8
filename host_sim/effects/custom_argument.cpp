#include "effects/custom_argument.hpp"

#include "common/error.hpp"
#include "common/text.hpp"
#include "effects/law.hpp"

#include <algorithm>

namespace servoid {

namespace {

bool is_known(const std::string& name) {
    const auto in = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return in(law_variables()) || in(law_functions());
}

void set_start(EffectTerm& term, const std::string& text) {
    const size_t equals = text.find('=');
    const std::string key(trim(text.substr(0, equals)));
    const auto value =
        equals == std::string::npos ? std::nullopt : parse_number(trim(text.substr(equals + 1)));
    if (!value)
        throw UsageError(term.name + ": " + in_quotes(text) +
                         " is no start value; expected one such as vs=0.1");
    if (!term.parameters.contains(key))
        throw UsageError(term.name + ": the law has no parameter " + in_quotes(key) +
                         " that could start at a value");
    term.parameters[key] = *value;
}

} // namespace

bool is_custom(const std::string& argument) {
    return argument == "custom" || argument.starts_with("custom.") ||
           argument.starts_with("custom=");
}

EffectTerm parse_custom(const std::string& argument) {
    const size_t equals = argument.find('=');
    if (equals == std::string::npos || !argument.starts_with("custom."))
        throw UsageError("custom needs a name and a law; expected for example "
                         "'custom.cubic=k*theta^3'");
    EffectTerm term;
    term.name = trim(argument.substr(0, equals));
    if (const std::string why = fault_of_name(term.name.substr(7)); !why.empty())
        throw UsageError(why);
    std::vector<std::string> parts = split(argument.substr(equals + 1), ';');
    term.law = parts.front();
    std::vector<std::string> keys;
    for (const LawName& name : names_in(term.law))
        if (!is_known(name.text) && !name.called) term.parameters[name.text] = 1;
    for (const auto& [key, value] : term.parameters)
        keys.push_back(key);
    if (const auto fault = find_fault(term.law, keys))
        throw UsageError(term.name + ": " + fault->reason);
    for (size_t i = 1; i < parts.size(); ++i)
        set_start(term, parts[i]);
    return term;
}

} // namespace servoid
