// A master's session on the bus as the user sees it: what it takes to begin one, what is kept of
// it, and what is told of its troubles.
#pragma once

#include "can/bus_report.hpp"
#include "can/socketcan.hpp"
#include "cli/app.hpp"
#include "cli/end_on_signal.hpp"
#include "node/master.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace servoid::cli {

struct SessionFiles {
    std::string interface;
    std::string out, log; // capture and candump log; empty: not kept
};

// The bus and the link on it.
class BusSession {
  public:
    // Ctrl-C ends what runs (BusError, "stopped by the user"), and the drive is left at rest.
    BusSession(const SessionFiles& files, const LinkOptions& link, const Output& output);
    BusSession(const BusSession&) = delete;
    BusSession& operator=(const BusSession&) = delete;

    Link& link() { return link_; }
    const LinkReport& report() const { return link_.report(); }
    void set_drive_counts(const DriveCounts& counts) { drive_ = counts; }

    // However the work ends, what was recorded until then is kept; a fault says what else was seen.
    template <class Work> auto run(const Work& work) {
        try {
            return work();
        } catch (const can::BusError& e) {
            keep(heard());
            throw can::BusError(with_troubles(e.what()));
        }
    }

    // Telemetry as captures; nothing where too little came.
    std::optional<can::BusCaptures> heard() const;
    // The longest stretch goes into the capture's file, everything into the log.
    void keep(const std::optional<can::BusCaptures>& all) const;

    Json json() const;
    void print_troubles() const;
    // "FIRST; 3 of 50 requests ... were sent again; ..."
    std::string with_troubles(const std::string& first) const;

  private:
    LinkOptions wired(LinkOptions link);
    std::vector<std::string> troubles() const;

    SessionFiles files_;
    const Output& output_;
    std::string log_;
    EndOnSignal signals_;
    can::SocketCan bus_;
    Link link_;
    DriveCounts drive_;
};

} // namespace servoid::cli
