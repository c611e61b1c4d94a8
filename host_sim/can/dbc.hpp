// Messages and signals of a DBC file: as much of it as says where a signal's bits are.
#pragma once

#include "can/field.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid::can {

struct DbcSignal {
    Field field;              // its name is the signal's alone
    std::string unit;         // UTF-8, whatever the file was in
    bool multiplexed = false; // `m0`: there or not, as the multiplexer says
    bool multiplexor = false; // `M`: the multiplexer; `m0M` is both
    double minimum = 0, maximum = 0;
    long line = 0;
    std::string fault; // why no frame holds it; "" where one does
    long fault_line = 0;
};

struct DbcMessage {
    std::string name;
    FrameId frame;
    int bytes = 0; // more than 64: in several frames
    long line = 0;
    std::vector<DbcSignal> signals;
};

struct Dbc {
    std::string path;
    std::map<std::string, DbcMessage> messages; // by name
};

// BO_, SG_, SIG_VALTYPE_ (floats); every other section is passed over, and so are the signals that
// belong to no message (VECTOR__INDEPENDENT_SIG_MSG). FileError with line: a malformed line, two
// messages of one name or identifier, two signals of one name in a message, a string that is not
// closed.
Dbc read_dbc(const std::string& path);
Dbc parse_dbc(const std::string& text, const std::string& path); // path: for messages

// "Message.Signal". Throws FileError: no such message or signal (the nearest names are said), a
// multiplexed signal ("multiplexed signals are not supported"), one that leaves its message or
// belongs to one of several frames.
const DbcSignal& find_signal(const Dbc& dbc, const std::string& message_and_signal);

} // namespace servoid::can
