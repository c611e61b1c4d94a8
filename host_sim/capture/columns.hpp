// What a column's name says: which signal, in which unit.
#pragma once

#include <string>
#include <vector>

namespace servoid {

enum class Signal {
    time,
    torque_ref,
    torque,
    position,
    velocity,
    position_ref,
    velocity_ref,
    load_position,
    segment
};

// Which kind of axis a unit belongs to; `either` for s, A, per mille and counts.
enum class Family { either, rotary, linear };

// What a unit must be multiplied with that the column does not say itself.
enum class Scale { none, rated_torque, torque_constant, position_per_count };

struct ColumnMeaning {
    Signal signal = Signal::time;
    Family family = Family::either;
    Scale needs = Scale::none;
    // SI = value * factor / divisor + offset. Two numbers, because x / 1000 is exact to the last
    // digit where x * 0.001 is not.
    double factor = 1, divisor = 1, offset = 0;
    double si(double value) const { return value * factor / divisor + offset; }
    double step(double quantum) const; // the same for a difference, positive
};

// Every accepted column name with its meaning.
struct KnownColumn {
    std::string name;
    ColumnMeaning meaning;
};
const std::vector<KnownColumn>& known_columns();

// nullptr where the name is not one of them.
const ColumnMeaning* find_column(const std::string& name);

// Why a name is not accepted, and what was expected.
std::string column_mistake(const std::string& name);

// Names without a unit ("force_ref"), as map files use them; the meaning is then in SI.
const std::vector<KnownColumn>& bare_signals();

// "position", "measured torque", ...
std::string signal_name(Signal signal);

} // namespace servoid
