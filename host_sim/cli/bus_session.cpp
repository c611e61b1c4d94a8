#include "cli/bus_session.hpp"

#include "can/candump.hpp"
#include "cli/bus_output.hpp"
#include "common/file.hpp"

#include <fmt/format.h>

namespace servoid::cli {

namespace {

can::SocketCanOptions what_it_hears(const LinkOptions& link) {
    can::SocketCanOptions out;
    out.listen_to = {can::telemetry_id(link.node),  can::answer_id(link.node),
                     can::heartbeat_id(link.node),  can::request_id(link.node),
                     can::references_id(link.node), can::heartbeat_id(link.master)};
    return out;
}

} // namespace

BusSession::BusSession(const SessionFiles& files, const LinkOptions& link, const Output& output)
    : files_(files), output_(output), bus_(files.interface, what_it_hears(link)),
      link_(bus_, wired(link)) {}

LinkOptions BusSession::wired(LinkOptions link) {
    link.cancelled = [] { return EndOnSignal::wanted().load(); };
    if (!files_.log.empty())
        link.heard = [this](const can::Frame& frame) {
            log_ += can::format_candump(frame, files_.interface) + "\n";
        };
    return link;
}

Json BusSession::json() const {
    const LinkReport& r = link_.report();
    const can::BusHealth& h = bus_.health();
    return {{"requests", r.requests},
            {"repeated_requests", r.repeated_requests},
            {"repeated_syncs", r.repeated_syncs},
            {"stray_answers", r.stray_answers},
            {"foreign_requests", r.foreign_requests},
            {"foreign_changes", r.foreign_changes},
            {"references_refused", drive_.references_refused},
            {"telemetry_rows_lost", drive_.rows_lost},
            {"error_frames", h.error_frames},
            {"bus_off", h.bus_off},
            {"interface_down", h.interface_down},
            {"dropped", h.dropped},
            {"not_sent", h.not_sent}};
}

// What went wrong on the way, and what was done about it; nothing on a good bus.
std::vector<std::string> BusSession::troubles() const {
    std::vector<std::string> out;
    const LinkReport& r = link_.report();
    const can::BusHealth& h = bus_.health();
    const auto tell = [&](long times, const std::string& text) {
        if (times > 0) out.push_back(text);
    };
    tell(r.repeated_requests + r.repeated_syncs,
         fmt::format("{} of {} requests and {} SYNC were sent again", r.repeated_requests,
                     r.requests, r.repeated_syncs));
    tell(r.foreign_requests,
         fmt::format("another master talks to this node: {} frames, {} of them with effect",
                     r.foreign_requests, r.foreign_changes));
    tell(drive_.references_refused,
         fmt::format("{} frames of references came after a lost one, and were sent again",
                     drive_.references_refused));
    tell(drive_.rows_lost,
         fmt::format("{} rows of telemetry found no room in the drive", drive_.rows_lost));
    tell(h.bus_off, fmt::format("bus off {} times", h.bus_off));
    tell(h.interface_down, fmt::format("the interface was down {} times", h.interface_down));
    tell(h.dropped, fmt::format("{} frames found no room here", h.dropped));
    tell(h.not_sent, fmt::format("{} frames could not be sent", h.not_sent));
    tell(link_.telemetry().resets(),
         fmt::format("the drive was reset {} times", link_.telemetry().resets()));
    return out;
}

void BusSession::print_troubles() const {
    for (const std::string& text : troubles())
        output_.line(text);
}

std::string BusSession::with_troubles(const std::string& first) const {
    std::string out = first;
    for (const std::string& text : troubles())
        out += "; " + text;
    return out;
}

std::optional<can::BusCaptures> BusSession::heard() const {
    try {
        can::BusCaptures out = link_.telemetry().captures(files_.interface);
        out.report.dropped = bus_.health().dropped;
        out.report.interface_down = bus_.health().interface_down;
        return out;
    } catch (const Error& e) {
        output_.note(std::string("no capture: ") + e.what());
        return std::nullopt;
    }
}

void BusSession::keep(const std::optional<can::BusCaptures>& all) const {
    if (!files_.log.empty()) write_file(files_.log, log_);
    if (!all) return;
    print_bus(output_, *all, true);
    if (files_.out.empty()) return;
    const Capture& capture = longest(all->captures);
    write_file(files_.out, format_capture_csv(capture));
    const std::size_t stretches = all->captures.size();
    output_.line(fmt::format("wrote {}: {} samples{}", files_.out, capture.rows(),
                             stretches == 1 ? ""
                                            : fmt::format(", the longest of {} stretches without "
                                                          "a lost sample",
                                                          stretches)));
}

} // namespace servoid::cli
