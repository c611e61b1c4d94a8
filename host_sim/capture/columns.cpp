#include "capture/columns.hpp"

#include "common/text.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace servoid {

namespace {

constexpr double turn = 2 * std::numbers::pi;

struct Unit {
    const char* suffix;
    Family family;
    Scale needs;
    double factor, divisor;
};

using Units = std::vector<Unit>;

const Units time_units = {{"s", Family::either, Scale::none, 1, 1},
                          {"ms", Family::either, Scale::none, 1, 1e3},
                          {"us", Family::either, Scale::none, 1, 1e6}};
// Per mille of rated is what CiA 402 linear drives send too, so it does not decide the axis.
const Units torque_units = {{"Nm", Family::rotary, Scale::none, 1, 1},
                            {"mNm", Family::rotary, Scale::none, 1, 1e3},
                            {"permille", Family::either, Scale::rated_torque, 1, 1e3}};
const Units force_units = {{"N", Family::linear, Scale::none, 1, 1},
                           {"permille", Family::linear, Scale::rated_torque, 1, 1e3}};
const Units current_units = {{"A", Family::either, Scale::torque_constant, 1, 1}};
const Units position_units = {{"rad", Family::rotary, Scale::none, 1, 1},
                              {"rev", Family::rotary, Scale::none, turn, 1},
                              {"deg", Family::rotary, Scale::none, turn, 360},
                              {"count", Family::either, Scale::position_per_count, 1, 1},
                              {"m", Family::linear, Scale::none, 1, 1},
                              {"mm", Family::linear, Scale::none, 1, 1e3}};
const Units velocity_units = {{"rad_s", Family::rotary, Scale::none, 1, 1},
                              {"rpm", Family::rotary, Scale::none, turn, 60},
                              {"rev_s", Family::rotary, Scale::none, turn, 1},
                              {"deg_s", Family::rotary, Scale::none, turn, 360},
                              {"m_s", Family::linear, Scale::none, 1, 1},
                              {"mm_s", Family::linear, Scale::none, 1, 1e3}};

struct Base {
    const char* name;
    Signal signal;
    const Units* units; // nullptr: none
    Family family;      // of the bare name
};

const std::vector<Base> bases = {
    {"time", Signal::time, &time_units, Family::either},
    {"torque_ref", Signal::torque_ref, &torque_units, Family::rotary},
    {"force_ref", Signal::torque_ref, &force_units, Family::linear},
    {"current_ref", Signal::torque_ref, &current_units, Family::either},
    {"torque", Signal::torque, &torque_units, Family::rotary},
    {"force", Signal::torque, &force_units, Family::linear},
    {"current", Signal::torque, &current_units, Family::either},
    {"position_ref", Signal::position_ref, &position_units, Family::either},
    {"position", Signal::position, &position_units, Family::either},
    {"velocity_ref", Signal::velocity_ref, &velocity_units, Family::either},
    {"velocity", Signal::velocity, &velocity_units, Family::either},
    {"load_position", Signal::load_position, &position_units, Family::either},
    {"segment", Signal::segment, nullptr, Family::either},
};

std::vector<KnownColumn> build_known() {
    std::vector<KnownColumn> known;
    for (const Base& base : bases) {
        if (!base.units)
            known.push_back({base.name, {base.signal, Family::either}});
        else
            for (const Unit& unit : *base.units)
                known.push_back(
                    {std::string(base.name) + "_" + unit.suffix,
                     {base.signal, unit.family, unit.needs, unit.factor, unit.divisor}});
    }
    return known;
}

std::vector<KnownColumn> build_bare() {
    std::vector<KnownColumn> bare;
    for (const Base& base : bases) {
        ColumnMeaning meaning{base.signal, base.family};
        if (base.units == &current_units) meaning.needs = Scale::torque_constant;
        bare.push_back({base.name, meaning});
    }
    return bare;
}

std::string names_with_units(const Base& base) {
    if (!base.units) return base.name;
    std::vector<std::string> names;
    for (const Unit& unit : *base.units)
        names.push_back(std::string(base.name) + "_" + unit.suffix);
    return join(names);
}

} // namespace

double ColumnMeaning::step(double quantum) const { return std::abs(quantum * factor / divisor); }

const std::vector<KnownColumn>& known_columns() {
    static const std::vector<KnownColumn> known = build_known();
    return known;
}

const std::vector<KnownColumn>& bare_signals() {
    static const std::vector<KnownColumn> bare = build_bare();
    return bare;
}

const ColumnMeaning* find_column(const std::string& name) {
    for (const KnownColumn& column : known_columns())
        if (column.name == name) return &column.meaning;
    return nullptr;
}

std::string column_mistake(const std::string& name) {
    if (name.empty()) return "a column has no name";
    std::vector<std::string> names;
    for (const KnownColumn& column : known_columns())
        names.push_back(column.name);
    // A slip of case or of one letter before the unit: position_Rad, Time_s.
    for (const auto& known : names)
        if (lower_case(known) == lower_case(name))
            return "unknown column " + in_quotes(name) + "; did you mean \"" + known + "\"?";
    const Base* longest = nullptr;
    for (const Base& base : bases) {
        if (name == base.name)
            return "column " + in_quotes(name) + " has no unit; expected one of " +
                   names_with_units(base);
        const std::string stem = std::string(base.name) + "_";
        if (name.rfind(stem, 0) == 0 &&
            (!longest || stem.size() > std::string(longest->name).size()))
            longest = &base;
    }
    if (longest)
        return "column " + in_quotes(name) + " has an unknown unit; expected " +
               names_with_units(*longest);
    const std::string closest = closest_name(name, names);
    return "unknown column " + in_quotes(name) +
           (closest.empty() ? "; expected names such as time_s, torque_ref_Nm, force_N, current_A, "
                              "position_rad, velocity_rpm, or a map file (--map) for foreign names"
                            : "; did you mean \"" + closest + "\"?");
}

std::string signal_name(Signal signal) {
    static const std::map<Signal, std::string> names = {
        {Signal::time, "time"},
        {Signal::torque_ref, "torque reference"},
        {Signal::torque, "measured torque"},
        {Signal::position, "position"},
        {Signal::velocity, "velocity"},
        {Signal::position_ref, "position reference"},
        {Signal::velocity_ref, "velocity reference"},
        {Signal::load_position, "load position"},
        {Signal::segment, "segment"}};
    return names.at(signal);
}

} // namespace servoid
