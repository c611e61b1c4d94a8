// Which bits of which frames are which signals, and what tells the instant of a sample.
#pragma once

#include "can/dbc.hpp"
#include "can/field.hpp"
#include "capture/columns.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace servoid::can {

struct MappedSignal {
    std::string name; // "torque", "position_count": as a column of a capture
    ColumnMeaning meaning;
    Field field;
};

struct FrameMap {
    std::string path; // for messages
    std::vector<MappedSignal> signals;
    std::optional<FrameId> sync;       // a frame at each sampling instant, before its data
    std::optional<Field> counter;      // sequence number of the cycle
    std::optional<Field> device_time;  // of the drive; its scale makes seconds of it
    std::optional<double> period_s;    // stated; else found
    std::optional<int> cia402_node;    // whose answers to SDO reads tell its scales
    std::optional<int> telemetry_node; // servoid's own frames (telemetry.hpp) in place of fields
    std::string interface;             // "": that of the first frame that is mapped
    std::map<std::string, std::string> metadata;
};

// From a map file: [signals.NAME] with id, start_bit, length, byte_order, signed, scale, offset
// (and `extended`, `type = "float"`); [bus] with sync, period_s, interface; [bus.counter] and
// [bus.time]. Or [bus] with profile, node, tpdo, objects. FileError: a field that leaves its frame,
// two that overlap, a wrong name or type.
FrameMap read_frame_map(const std::string& path);

// From a DBC: signal name ("torque", "position") to "Message.Signal" or "Message.Signal:unit".
FrameMap map_from_dbc(const std::string& path, const std::map<std::string, std::string>& signals);

// The profile CiA 402: SYNC 0x80 and one TPDO of the node that holds these objects, in their order.
FrameMap map_of_cia402(int node, int tpdo, const std::vector<std::string>& objects);

// The telemetry of a servoid drive (SPEC.md, "On the bus").
FrameMap map_of_telemetry(int node);

// Status word, position and torque actual value: 6041, 6064, 6077.
const std::vector<std::string>& default_objects();

// Of the frames that hold signals, the counter or the device time; SYNC aside. Each once.
std::vector<FrameId> data_identifiers(const FrameMap& map);
std::vector<FrameId> mapped_identifiers(const FrameMap& map); // and SYNC

// Throws FileError where a field leaves its frame or two of them overlap.
void check_map(const FrameMap& map);

} // namespace servoid::can
