#include "can/bus_log.hpp"

#include "can/candump.hpp"
#include "can/collector.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid::can {

namespace {

constexpr std::int64_t kEnabled = 0x0237;  // status word: operation enabled
constexpr std::int64_t kAnswer_ns = 40000; // a TPDO after its SYNC: its own length on the bus

// The interface that carries the data: as the map says, else that of the first mapped frame. A SYNC
// of another bus is none of this one.
std::string interface_of(const std::string& text, const FrameMap& map, const std::string& path) {
    if (!map.interface.empty()) return map.interface;
    CandumpReader reader(text, path);
    const std::vector<FrameId> data = data_identifiers(map);
    for (Frame frame; reader.next(frame);)
        if (!frame.error && std::find(data.begin(), data.end(), id_of(frame)) != data.end())
            return reader.interfaces()[frame.interface];
    return "";
}

std::int64_t rounded(double value, const Field& field) {
    const double most = std::ldexp(1.0, field.length - 1);
    const double r = std::round(value);
    if (r < -most || r >= most)
        throw UsageError(
            fmt::format("--out: {} of {:.6g} does not fit its object", field.name, value));
    return std::int64_t(r);
}

} // namespace

BusCaptures read_candump(const std::string& path, const FrameMap& map,
                         const CaptureScales& scales) {
    const std::string text = read_file(path);
    const std::string interface = interface_of(text, map, path);
    CandumpReader reader(text, path);
    Collector table(map);
    for (Frame frame; reader.next(frame);)
        if (reader.interfaces()[frame.interface] == interface) table.add(frame);
    BusCaptures out = table.captures(path, scales);
    out.report.dropped = long(reader.dropped());
    return out;
}

std::string format_candump_log(const Capture& capture, const CaptureScales& scales) {
    if (!(scales.rated_torque > 0) || !(scales.position_per_count > 0))
        throw UsageError("--out: a candump log holds counts and per mille of rated torque; add "
                         "[sensor] and drive.rated_torque to the model");
    const FrameMap map = map_of_cia402(1, 1, {"6041", "6064", "6074"});
    const Field &position = map.signals[0].field, &torque = map.signals[1].field;
    std::string out;
    for (std::size_t i = 0; i < capture.rows(); ++i) {
        Frame sync;
        sync.id = map.sync->id;
        sync.time_ns = std::llround(capture.time_s[i] * 1e9);
        Frame tpdo;
        tpdo.id = position.frame.id, tpdo.length = 8, tpdo.time_ns = sync.time_ns + kAnswer_ns;
        put_raw({"", position.frame, 0, 16}, kEnabled, tpdo);
        put_raw(position, rounded(capture.position[i] / scales.position_per_count, position), tpdo);
        put_raw(torque, rounded(1000 * capture.torque_ref[i] / scales.rated_torque, torque), tpdo);
        for (const Frame* frame : {&sync, &tpdo})
            out += format_candump(*frame, "can0") + "\n";
    }
    return out;
}

} // namespace servoid::can
