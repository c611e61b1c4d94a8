#include "cli/replay_live.hpp"

#include "can/record.hpp"
#include "can/socketcan.hpp"
#include "cli/bus_output.hpp"
#include "cli/end_on_signal.hpp"
#include "common/file.hpp"

#include <fmt/format.h>

namespace servoid::cli {

namespace {

can::BusCaptures captures_of(const can::Recorder& recorder, const can::Bus& bus,
                             const std::string& interface, const CaptureScales& scales) {
    const can::BusHealth& health = bus.health();
    const bool complete = health.dropped + health.interface_down + health.bus_off == 0;
    can::BusCaptures out = recorder.table().captures(interface, scales, complete);
    out.report.dropped = health.dropped;
    out.report.interface_down = health.interface_down;
    return out;
}

// After the bus failed. Too little for a capture is no second error.
void save_capture(const can::Recorder& recorder, const can::Bus& bus, const LiveOptions& options,
                  const CaptureScales& scales, const Output& output, const std::string& out) {
    if (out.empty()) return;
    try {
        const auto heard = captures_of(recorder, bus, options.interface, scales);
        write_file(out, format_capture_csv(longest(heard.captures)));
    } catch (const Refusal& e) {
        output.note(out + " is not written: " + e.reason());
    }
}

} // namespace

void add_live_options(const Verb& verb, LiveOptions& options) {
    const Argument can = verb.add_option("--can", options.interface,
                                         "listen to this interface in place of a log: can0, vcan0");
    verb.add_option("--for", options.for_s, "s of recording (else until the drive falls silent)")
        .positive()
        .needs(can);
    verb.add_option("--idle", options.idle_s, "s of silence that end the recording (default 2)")
        .positive()
        .needs(can);
    verb.add_option("--wait", options.wait_s, "s to wait for the first frame (default 10)")
        .positive()
        .needs(can);
    verb.add_option("--log", options.log, "also write what was heard as a candump log").needs(can);
}

can::BusCaptures record_live(const LiveOptions& options, const can::FrameMap& map,
                             const CaptureScales& scales, const Output& output,
                             const std::string& out) {
    const EndOnSignal signals;
    can::SocketCan bus(options.interface); // everything, to tell what is there in place of a drive
    can::Recorder recorder(map, options.interface, !options.log.empty());
    can::RecordOptions record;
    record.for_s = options.for_s, record.idle_s = options.idle_s, record.wait_s = options.wait_s;
    record.stop = &EndOnSignal::wanted();
    record.begun = [&] { bus.listen_to(can::mapped_identifiers(map)); };
    output.note("listening on " + options.interface + "; Ctrl-C ends the recording");
    try {
        recorder.run(bus, record);
    } catch (const can::BusError&) {
        if (!options.log.empty()) write_file(options.log, recorder.log());
        save_capture(recorder, bus, options, scales, output, out);
        throw;
    }
    if (!options.log.empty()) write_file(options.log, recorder.log());
    return captures_of(recorder, bus, options.interface, scales);
}

} // namespace servoid::cli
