// servoid drive: a simulated drive on a CAN bus, with the firmware core as its node.
#include "can/socketcan.hpp"
#include "can/telemetry.hpp"
#include "cli/app.hpp"
#include "cli/end_on_signal.hpp"
#include "mystery/mystery.hpp"
#include "node/simulated_node.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <optional>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    NodeOptions node;
    std::string model, interface, hidden_for;
    std::optional<std::uint64_t> mystery;
    std::optional<double> for_s;
};

Model model_of(const Options& o) {
    const Model model = read_model(o.model);
    if (!o.mystery) return model;
    const Mystery mystery =
        make_mystery(model, parse_experiment(o.hidden_for), *o.mystery, o.node.drive.seed);
    return with_hidden(model, mystery.hidden);
}

can::SocketCanOptions what_it_hears(const NodeOptions& node) {
    can::SocketCanOptions out;
    out.send_wait = std::chrono::milliseconds(2); // the control goes on, whatever the bus takes
    out.listen_to = {
        {0x000, false}, {0x080, false}, can::request_id(node.node), can::references_id(node.node)};
    for (int any = 1; any < 128; ++any) // the master may choose its number; and a twin is heard
        out.listen_to.push_back(can::heartbeat_id(any));
    return out;
}

std::string state_name(sid_state_t state) {
    static const char* const names[] = {"idle", "measuring", "stopping", "done", "aborted"};
    return names[state];
}

Json to_json(const NodeReport& r, const can::BusHealth& bus) {
    return {{"schema", "servoid.drive/1"},
            {"runs", r.runs},
            {"state", state_name(r.state)},
            {"reason", sid_reason_text(r.reason)},
            {"periods", r.periods},
            {"held_periods_after_heartbeat", r.held ? Json(r.held_after) : Json(nullptr)},
            {"speed", r.speed},
            {"lost_time_s", r.lost_time_s},
            {"resets", r.resets},
            {"sent", bus.sent},
            {"not_sent", bus.not_sent},
            {"received", bus.received},
            {"dropped", bus.dropped},
            {"telemetry_rows_lost", r.rows_lost},
            {"reference_frames_refused", r.references_refused},
            {"error_frames", bus.error_frames},
            {"bus_off", bus.bus_off},
            {"interface_down", bus.interface_down}};
}

void print(const Output& out, const NodeReport& r, const can::BusHealth& bus) {
    out.line(fmt::format("{} run{}, the last one {} ({}); speed at the end {:.3g}", r.runs,
                         r.runs == 1 ? "" : "s", state_name(r.state), sid_reason_text(r.reason),
                         r.speed));
    if (r.held)
        out.line(fmt::format("the axis was held {} control periods after the master's last "
                             "heartbeat",
                             r.held_after));
    if (r.lost_time_s > 0)
        out.line(fmt::format("this machine was too slow for real time by {:.3g} s", r.lost_time_s));
    out.line(fmt::format("{} frames sent, {} found no room on the bus", bus.sent, bus.not_sent));
    const auto tell = [&](const char* what, long times) {
        if (times > 0) out.line(fmt::format("{}: {}", what, times));
    };
    tell("resets", r.resets), tell("bus off", bus.bus_off);
    tell("interface down", bus.interface_down), tell("received, but no room for it", bus.dropped);
    tell("rows of telemetry lost", r.rows_lost);
    tell("frames of references refused", r.references_refused);
}

void run_drive(const Options& o) {
    const Model model = model_of(o);
    const EndOnSignal signals;
    can::SocketCan bus(o.interface, what_it_hears(o.node));
    SimulatedNode node(model, o.node, bus);
    o.output.note(fmt::format("node {} on {}: {}, {}; Ctrl-C ends it", o.node.node, o.interface,
                              model.name,
                              o.node.free_running ? "free-running (SYNC)" : "in real time"));
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(o.for_s.value_or(1e9));
    const auto stop = [&] {
        return EndOnSignal::wanted() || std::chrono::steady_clock::now() >= end;
    };
    const auto tell = [&] {
        o.output.print_json(to_json(node.report(), bus.health()));
        print(o.output, node.report(), bus.health());
    };
    try {
        node.run(stop);
    } catch (const can::BusError&) {
        tell(); // at rest all the same
        throw;
    }
    tell();
}

} // namespace

void add_drive(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "drive", "a simulated drive on a CAN bus");
    verb.add_option("model", o->model, "model file (TOML) with a [controller]").required();
    verb.add_option("--can", o->interface, "interface: can0, vcan0").required();
    verb.add_option("--node", o->node.node, "number of the node (default 1)").between(1, 127);
    verb.add_flag("--free", o->node.free_running,
                  "free-running: 40 control periods for each SYNC of the master");
    verb.add_option("--timeout", o->node.master_timeout_ms,
                    "ms without the master's heartbeat after which the axis is held (default 500)")
        .between(1, 60000);
    verb.add_option("--stroke", o->node.stroke,
                    "rad or m from the start of a move beyond which the axis is held")
        .positive();
    verb.add_option("--torque-noise", o->node.drive.torque_noise,
                    "N·m or N: standard deviation of a torque that disturbs the axis, a sample")
        .not_negative();
    verb.add_option("--seed", o->node.drive.seed, "of the noise");
    const Argument mystery = verb.add_option(
        "--mystery", o->mystery, "hide one effect that the model lacks, for --hidden-for's move");
    mystery.needs(
        verb.add_option("--hidden-for", o->hidden_for,
                        "the move that shows the hidden effect (as simulate --experiment)")
            .needs(mystery));
    verb.add_option("--for", o->for_s, "s after which it ends (else Ctrl-C)").positive();
    add_output_options(verb, o->output);
    verb.examples("  servoid drive examples/system1.toml --can vcan0\n"
                  "  servoid drive motor.toml --can vcan0 --mystery 3 --hidden-for trapezoid");
    verb.callback([o] { run_drive(*o); });
}

} // namespace servoid::cli
