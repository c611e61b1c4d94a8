// Messages and signals of a DBC file: as much of it as says where a signal's bits are.
#pragma once

#include "can/field.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid::can {

struct DbcSignal {
    Field field;
    std::string unit;
    bool multiplexed = false; // or the multiplexer itself decides whether it is there
    bool multiplexor = false;
    double minimum = 0, maximum = 0;
    long line = 0;
};

struct DbcMessage {
    std::string name;
    FrameId frame;
    int bytes = 0;
    long line = 0;
    std::vector<DbcSignal> signals;
};

struct Dbc {
    std::string path;
    std::map<std::string, DbcMessage> messages; // by name
};

// BO_, SG_, SIG_VALTYPE_ (floats); every other section is passed over. FileError with line: a
// malformed line, a signal that leaves its message, two messages of one name or identifier.
Dbc read_dbc(const std::string& path);

// "Message.Signal". Throws FileError: no such message or signal (the nearest names are said), a
// multiplexed signal ("multiplexed signals are not supported").
const DbcSignal& find_signal(const Dbc& dbc, const std::string& message_and_signal);

} // namespace servoid::can
