#include "cli/bus_options.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <charconv>

namespace servoid::cli {

namespace {

can::FrameId parse_id(const std::string& text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    const std::string digits = hex ? text.substr(2) : text;
    std::uint32_t id = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, id, hex ? 16 : 10);
    if (error != std::errc() || stop != end || id > 0x1FFFFFFF)
        throw UsageError("--sync: " + in_quotes(text) + " is no CAN identifier, such as 0x80");
    return {id, id > 0x7FF};
}

} // namespace

can::FrameMap BusOptions::frame_map() const {
    const int ways = int(!map.empty()) + int(!dbc.empty()) + int(!profile.empty());
    if (ways != 1)
        throw UsageError("what the frames mean: one of --map FILE, --dbc FILE, --profile NAME");
    if (dbc.empty() && !signals.empty())
        throw UsageError("--torque, --position and the like name signals of a --dbc FILE");
    can::FrameMap out = !map.empty()           ? can::read_frame_map(map)
                        : !dbc.empty()         ? can::map_from_dbc(dbc, signals)
                        : profile == "servoid" ? can::map_of_telemetry(node)
                                               : can::map_of_cia402(node, tpdo, objects);
    if (!sync.empty()) out.sync = parse_id(sync);
    if (period_s) out.period_s = period_s;
    return out;
}

void add_bus_options(const Verb& verb, BusOptions& options) {
    verb.add_option("--map", options.map, "TOML file: [signals.torque] id, start_bit, length, ...");
    verb.add_option("--dbc", options.dbc, "DBC file, with --torque and --position out of it");
    for (const char* name : {"torque", "torque_ref", "position", "position_ref", "velocity"}) {
        std::string flag = std::string("--") + name;
        std::replace(flag.begin(), flag.end(), '_', '-');
        verb.add_option_function(
            flag, [&options, name](const std::string& said) { options.signals[name] = said; },
            "Message.Signal of the DBC, or Message.Signal:UNIT");
    }
    verb.add_option("--profile", options.profile,
                    "cia402: SYNC 0x80 and one TPDO of a node; servoid: our telemetry")
        .one_of({"cia402", "servoid"});
    verb.add_option("--node", options.node, "of the profile").between(1, 127);
    verb.add_option("--tpdo", options.tpdo, "of the profile").between(1, 4);
    verb.add_option("--objects", options.objects,
                    "of the TPDO, in their order (default: 6041 6064 6077)");
    verb.add_option("--sync", options.sync, "identifier of the frame at each sampling instant");
    verb.add_option("--period", options.period_s,
                    "the cycle, s, where it is known (else found from the arrivals)")
        .positive();
}

} // namespace servoid::cli
