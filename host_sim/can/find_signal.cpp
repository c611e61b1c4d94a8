#include "can/dbc.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

namespace servoid::can {

namespace {

// A file may have thousands of names: all of them are said only where they are few.
std::string hint(const std::string& wrong, const std::vector<std::string>& names) {
    constexpr size_t few = 12;
    if (names.empty()) return "; it has none";
    if (names.size() <= few || !closest_name(wrong, names).empty()) return suggestion(wrong, names);
    return "; none of its " + std::to_string(names.size()) + " has a name like it";
}

const DbcMessage& find_message(const Dbc& dbc, const std::string& name) {
    const auto found = dbc.messages.find(name);
    if (found != dbc.messages.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [message, unused] : dbc.messages)
        names.push_back(message);
    throw FileError(dbc.path, 0, "has no message " + in_quotes(name) + hint(name, names));
}

} // namespace

const DbcSignal& find_signal(const Dbc& dbc, const std::string& message_and_signal) {
    const auto point = message_and_signal.find('.');
    if (point == std::string::npos)
        throw FileError(dbc.path, 0,
                        in_quotes(message_and_signal) +
                            " is no signal's full name; expected MESSAGE.SIGNAL");
    const DbcMessage& message = find_message(dbc, message_and_signal.substr(0, point));
    const std::string name = message_and_signal.substr(point + 1);
    std::vector<std::string> names;
    for (const auto& signal : message.signals) {
        if (signal.field.name == name && signal.multiplexed)
            throw FileError(dbc.path, signal.line,
                            "signal " + in_quotes(message_and_signal) +
                                " is multiplexed; multiplexed signals are not supported");
        if (signal.field.name == name && !signal.fault.empty())
            throw FileError(dbc.path, signal.fault_line,
                            "signal " + in_quotes(name) + ": " + signal.fault);
        if (signal.field.name == name) return signal;
        names.push_back(signal.field.name);
    }
    throw FileError(dbc.path, message.line,
                    "message " + in_quotes(message.name) + " has no signal " + in_quotes(name) +
                        hint(name, names));
}

} // namespace servoid::can
