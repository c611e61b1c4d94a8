// servoid command: the other end of a drive on the bus. Runs sessions and moves on it, and keeps
// what it tells.
#include "cli/app.hpp"
#include "cli/bus_output.hpp"
#include "cli/bus_session.hpp"
#include "cli/identify_output.hpp"
#include "common/error.hpp"
#include "diagnose/diagnose.hpp"
#include "node/go_and_move.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <iostream>
#include <limits>
#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    LinkOptions link;
    Limits limits;
    SessionFiles files;
    // identify
    std::vector<double> frequencies{50};
    double amplitude = 0;
    SessionOptions session;
    // move, next
    std::string experiment, model;
    CaptureOptions captures;
};

OnProgress on_terminal(const Output& output) {
    if (output.quiet || !isatty(STDERR_FILENO)) return {};
    return [](const RunProgress& p) {
        std::cerr << fmt::format("\r{:3.0f} %  {}, {} samples   ", 100 * p.share, p.what, p.samples)
                  << std::flush;
    };
}

// After the capture is safe: a fault of the drive or the bus is exit 5, data that cannot answer 4.
void refuse_if_not_whole(const RunEnd& end, const BusSession& s) {
    if (!end.fault.empty())
        throw can::BusError(s.with_troubles("the drive ended the run: " + end.fault));
    if (s.report().foreign_changes > 0)
        throw can::BusError(
            s.with_troubles("not what was asked for: another master has changed the drive"));
}

void refuse_if_no_answer(const std::vector<SessionResult>& results) {
    for (const SessionResult& r : results)
        if (r.reason != SID_OK)
            throw Refusal(
                fmt::format("at {:.4g} Hz: {}", r.frequency_Hz, sid_reason_text(r.reason)),
                r.reason == SID_SATURATED ? "a smaller amplitude or a lower frequency"
                                          : "another frequency or a larger amplitude");
}

// The drive's own answer, with the deviation that the capture of the same move gives where the
// drive has measured one window only.
std::vector<Identification> as_identifications(const std::vector<SessionResult>& results,
                                               const std::vector<Identification>& of_capture,
                                               const SessionOptions& session) {
    std::vector<Identification> out;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < results.size(); ++i) {
        const SessionResult& r = results[i];
        Identification one;
        if (i < of_capture.size()) one = of_capture[i];
        one.frequency_Hz = r.frequency_Hz, one.reason = r.reason, one.coulomb_leak = 0;
        one.first_period = session.ramp_periods + session.settle_periods;
        one.last_period = one.first_period + session.window_periods * session.windows;
        one.inertia.value = r.inertia, one.viscous.value = r.viscous;
        one.position_amplitude = r.position_amplitude, one.torque_amplitude = r.torque_amplitude;
        if (r.std_known) one.inertia.std = r.inertia_std, one.viscous.std = r.viscous_std;
        if (!r.std_known && i >= of_capture.size()) one.inertia.std = one.viscous.std = unknown;
        if (i >= of_capture.size()) one.constant_torque = {unknown, unknown}; // not the core's
        out.push_back(one);
    }
    return out;
}

// By the host, from the telemetry: only where one stretch holds the whole session of one frequency.
std::vector<Identification> from_telemetry(const std::optional<can::BusCaptures>& all,
                                           const Options& o) {
    if (!all || all->captures.size() != 1 || o.frequencies.size() != 1) return {};
    IdentifyOptions options;
    options.frequencies_Hz = o.frequencies, options.method = o.session.method;
    options.first_period = o.session.ramp_periods + o.session.settle_periods;
    options.last_period = *options.first_period + o.session.window_periods;
    try {
        return identify(all->captures.front(), options);
    } catch (const Refusal& e) {
        o.output.note("from the telemetry: " + e.reason());
        return {};
    }
}

struct Answer {
    RunEnd end;
    std::vector<SessionResult> results;
    bool linear = false;
};

Answer measured(BusSession& s, const Options& o) {
    Master master(s.link());
    std::vector<PlannedSine> plan;
    for (double f : o.frequencies)
        plan.push_back({f, o.amplitude});
    Answer out;
    out.linear = master.scales().linear;
    master.set_limits(o.limits);
    out.end = master.identify(plan, o.session, on_terminal(o.output));
    if (out.end.fault.empty() || is_refusal(out.end.status.reason))
        out.results = master.results(plan);
    master.finish();
    s.set_drive_counts(master.counts());
    return out;
}

void run_identify(const Options& o) {
    BusSession s(o.files, o.link, o.output);
    const Answer answer = s.run([&] { return measured(s, o); });
    const auto all = s.heard();
    s.keep(all);
    if (is_refusal(answer.end.status.reason)) refuse_if_no_answer(answer.results);
    refuse_if_not_whole(answer.end, s);
    refuse_if_no_answer(answer.results);
    const auto own = as_identifications(answer.results, from_telemetry(all, o), o.session);
    Capture none;
    none.linear = answer.linear;
    const Capture& capture = all ? longest(all->captures) : none;
    Json json = identification_json(own, capture);
    if (all) json["bus"] = bus_json(all->report);
    json["link"] = s.json();
    o.output.print_json(json);
    print_identification(o.output, own, capture);
    s.print_troubles();
}

Json move_json(const Options& o, const RunEnd& end, const std::optional<can::BusCaptures>& all,
               const BusSession& s) {
    Json json = {{"schema", "servoid.move/1"},
                 {"experiment", o.experiment},
                 {"status", end.fault.empty() ? "ok" : end.fault},
                 {"out", o.files.out.empty() ? Json(nullptr) : Json(o.files.out)},
                 {"samples", all ? longest(all->captures).rows() : 0},
                 {"stretches", all ? all->captures.size() : 0}};
    if (all) json["bus"] = bus_json(all->report);
    json["link"] = s.json();
    return json;
}

RunEnd moved(BusSession& s, const Options& o, const Experiment& experiment) {
    Master master(s.link());
    master.set_limits(o.limits);
    const RunEnd end = go_and_move(master, s.link(), experiment, on_terminal(o.output),
                                   [&](const std::string& text) { o.output.note(text); });
    s.set_drive_counts(master.counts());
    return end;
}

void run_move(const Options& o) {
    const Experiment experiment = parse_experiment(o.experiment);
    BusSession s(o.files, o.link, o.output);
    const RunEnd end = s.run([&] { return moved(s, o, experiment); });
    const auto all = s.heard();
    s.keep(all);
    o.output.print_json(move_json(o, end, all, s));
    s.print_troubles();
    refuse_if_not_whole(end, s);
}

// What `diagnose` would record next, recorded.
void run_next(Options o) {
    const Model model = read_model(o.model);
    const std::vector<Capture> captures = o.captures.read(&model);
    const std::vector<PreparedMotion> motions = prepare_all(captures, o.captures.motion());
    const Diagnosis d = diagnose(model, motions);
    o.output.note(std::string(verdict_name(d.verdict)) + ": " + d.advice);
    if (!d.next)
        throw Refusal("the diagnosis proposes no move: " + std::string(verdict_name(d.verdict)),
                      "what its advice says");
    o.experiment = d.next->experiment;
    o.output.note("next: " + o.experiment + "; " + d.next->reason);
    run_move(o);
}

void run_status(const Options& o) {
    BusSession s(o.files, o.link, o.output);
    const auto read = [&](std::uint8_t sub) { return s.link().read(0x2A02, sub); };
    const auto reason = sid_reason_t(read(2));
    static const char* const names[] = {"idle", "measuring", "stopping", "done", "aborted"};
    const std::uint32_t state = read(1), owner = s.link().read(0x2A01, 1);
    const std::string name = state < std::size(names) ? names[state] : "unknown";
    o.output.print_json({{"schema", "servoid.status/1"},
                         {"node", o.link.node},
                         {"state", name},
                         {"reason", sid_reason_text(reason)},
                         {"claimed", owner != 0},
                         {"tick", read(4)},
                         {"telemetry_rows_lost", read(5)}});
    o.output.line(fmt::format("node {}: {} ({}){}", o.link.node, name, sid_reason_text(reason),
                              owner != 0 ? ", claimed by a master" : ""));
}

void run_abort(const Options& o) {
    BusSession s(o.files, o.link, o.output);
    s.link().write(0x2A01, 5, 1, 1);
    o.output.print_json({{"schema", "servoid.abort/1"}, {"node", o.link.node}});
    o.output.line(fmt::format("node {}: its axis is held", o.link.node));
}

void add_link_options(const Verb& verb, Options& o) {
    verb.add_option("--can", o.files.interface, "interface: can0, vcan0").required();
    verb.add_option("--node", o.link.node, "number of the drive (default 1)").between(1, 127);
    verb.add_option("--master", o.link.master, "number of this master (default 127)")
        .between(1, 127);
    verb.add_option("--timeout", o.link.timeout_ms,
                    "ms without our heartbeat after which the drive holds its axis (default 500)")
        .between(20, 60000);
    verb.add_option("--torque-limit", o.limits.torque,
                    "N·m or N at which the drive holds its axis (default: its own)")
        .positive();
    verb.add_option("--stroke", o.limits.stroke,
                    "rad or m from the start of a run at which the drive holds its axis")
        .positive();
    verb.add_flag("--free", o.link.free_running, "the drive is free-running: give it SYNC");
    add_output_options(verb, o.output);
}

void add_out(const Verb& run, Options& o) {
    run.add_option("--out", o.files.out, "write what was recorded as .csv: the longest stretch");
    run.add_option("--log", o.files.log, "write all that was heard as a candump log");
}

void add_identify_run(const Verb& verb, const std::shared_ptr<Options>& o) {
    const Verb run(verb, "identify", "a session: inertia and viscous friction");
    run.add_option("--amplitude", o->amplitude, "rad or m of the reference: this moves the axis")
        .required()
        .positive();
    run.add_option("--frequency", o->frequencies, "Hz, one or more (default 50)").positive();
    run.add_option("--windows", o->session.windows, "at each frequency (default 1)").between(1, 8);
    run.add_option("--ramp", o->session.ramp_periods, "periods of a soft start (default 0)")
        .between(0, 255);
    add_out(run, *o);
    run.callback([o] { run_identify(*o); });
}

void add_move_run(const Verb& verb, const std::shared_ptr<Options>& o) {
    const Verb run(verb, "move", "any experiment, streamed");
    run.add_option("experiment", o->experiment, "as simulate --experiment").required();
    add_out(run, *o);
    run.callback([o] { run_move(*o); });
}

void add_next_run(const Verb& verb, const std::shared_ptr<Options>& o) {
    const Verb run(verb, "next", "the move that diagnose proposes");
    run.add_option("model", o->model, "model file (TOML)").required();
    run.add_option("captures", o->captures.files, "captures so far").required();
    add_capture_options(run, o->captures);
    add_out(run, *o);
    run.callback([o] { run_next(*o); });
}

} // namespace

void add_command(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "command", "run sessions and moves on a drive on the bus");
    add_link_options(verb, *o);
    add_identify_run(verb, o);
    add_move_run(verb, o);
    add_next_run(verb, o);
    Verb(verb, "status", "what the drive does").callback([o] { run_status(*o); });
    Verb(verb, "abort", "hold the axis now").callback([o] { run_abort(*o); });
    verb.examples(
        "  servoid command --can can0 identify --amplitude 0.5 --frequency 50 --out a.csv\n"
        "  servoid command --can can0 move trapezoid:stroke=6.28,velocity=40 --out b.csv\n"
        "  servoid command --can can0 next model.toml b.csv --out c.csv\n"
        "  servoid command --can can0 abort");
}

} // namespace servoid::cli
