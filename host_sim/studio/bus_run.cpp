#include "studio/bus_run.hpp"

#include "can/socketcan.hpp"
#include "common/error.hpp"

namespace servoid::studio {

namespace {

constexpr double kSpan_s = 2; // of what is shown while it arrives
constexpr std::size_t kPoints = 400;

can::SocketCanOptions heard(const LinkOptions& link) {
    can::SocketCanOptions out;
    out.listen_to = {can::telemetry_id(link.node),  can::answer_id(link.node),
                     can::heartbeat_id(link.node),  can::request_id(link.node),
                     can::references_id(link.node), can::heartbeat_id(link.master)};
    return out;
}

BusView view_of(const can::TelemetryTable& table) {
    BusView out;
    out.rows = table.rows();
    out.live = table.newest(kSpan_s, kPoints);
    if (!out.live.time_s.empty()) out.seconds = out.live.time_s.back();
    return out;
}

std::string moved(const Limits& limits, Link& link, const Experiment& experiment,
                  const OnProgress& progress) {
    Master master(link);
    master.set_limits(limits);
    const RunEnd end = go_and_move(master, link, experiment, progress, [](const std::string&) {});
    if (!end.fault.empty()) return "the drive ended the run: " + end.fault;
    return link.report().foreign_changes > 0
               ? "not what was asked for: another master has changed the drive"
               : "";
}

} // namespace

BusRun run_on_bus(const BusSetup& setup, const Experiment& experiment, const OnBus& on_bus) {
    bool goes_on = true;
    LinkOptions options = setup.link;
    options.cancelled = [&] { return !goes_on; };
    can::SocketCan bus(setup.interface, heard(options));
    Link link(bus, options);
    const OnProgress progress = [&](const RunProgress& p) {
        goes_on = on_bus(p, view_of(link.telemetry()));
    };
    BusRun out;
    try {
        out.fault = moved(setup.limits, link, experiment, progress);
    } catch (const can::BusError& e) {
        out.fault = e.what();
    }
    try {
        out.captures = link.telemetry().captures(setup.interface).captures;
    } catch (const Error& e) {
        if (out.fault.empty()) out.fault = e.what();
    }
    return out;
}

} // namespace servoid::studio
