// A simulated drive and a master on one bus, without a kernel: what a session and a move come to.
#include "can/memory_bus.hpp"
#include "faulty_bus.hpp"
#include "node/master.hpp"
#include "node/simulated_node.hpp"
#include "plant/simulate.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace servoid {
namespace {

Model system1() { return read_model(SERVOID_SOURCE_DIR "/examples/system1.toml"); }

// A free-running drive in a thread of its own.
class FreeDrive {
  public:
    explicit FreeDrive(can::MemoryBus& wire, NodeOptions options = {}) : end_(wire.end()) {
        options.free_running = true;
        node_ = std::make_unique<SimulatedNode>(system1(), options, *end_);
        thread_ = std::thread([this] { node_->run([this] { return stop_.load(); }); });
    }
    NodeReport stop() {
        stop_ = true;
        if (thread_.joinable()) thread_.join();
        return node_->report();
    }
    ~FreeDrive() { stop(); }

  private:
    std::unique_ptr<can::Bus> end_;
    std::unique_ptr<SimulatedNode> node_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

LinkOptions free_link() {
    LinkOptions out;
    out.free_running = true, out.answer_ms = 60, out.tries = 8;
    return out;
}

const std::vector<PlannedSine> kPlan = {{50, 1.0}, {100, 1.0}};

struct Answer {
    RunEnd end;
    std::vector<SessionResult> results;
    LinkReport link;
    std::optional<can::BusCaptures> heard;
    NodeReport drive;
};

Answer identify_with(const can::Faults& faults, unsigned seed) {
    can::MemoryBus wire;
    FreeDrive drive(wire);
    const auto end = wire.end();
    can::FaultyBus bus(*end, faults, seed);
    Link link(bus, free_link());
    Answer out;
    {
        Master master(link);
        out.end = master.identify(kPlan, {}, {});
        out.results = master.results(kPlan);
        master.finish();
    }
    out.link = link.report();
    out.heard = link.telemetry().captures("memory");
    out.drive = drive.stop();
    return out;
}

} // namespace

// By frames or by a call: the same core, the same drive, the same numbers.
TEST(Node, ASessionOverABusIsTheSessionAlone) {
    const Answer a = identify_with({}, 1);
    EXPECT_EQ(a.end.fault, "");
    SimulatedDrive alone(system1(), {});
    const auto expected = run_session(alone, kPlan, {});
    ASSERT_EQ(a.results.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(a.results[i].reason, SID_OK);
        // The second leg begins a few samples later, with the rest of the first one's motion.
        EXPECT_NEAR(a.results[i].inertia / expected[i].inertia, 1, i == 0 ? 1e-9 : 1e-3);
        EXPECT_NEAR(a.results[i].viscous / expected[i].viscous, 1, i == 0 ? 1e-9 : 1e-2);
    }
    ASSERT_EQ(a.heard->captures.size(), 1u);
    EXPECT_EQ(a.heard->report.lost, 0);
    EXPECT_EQ(a.drive.state, SID_STATE_DONE);
    EXPECT_EQ(a.drive.speed, 0);
    EXPECT_EQ(a.link.repeated_requests, 0);
}

// Telemetry suffers, the drive's own answer does not.
TEST(Node, LossRepetitionAndShortFramesDoNotMoveTheAnswer) {
    const Answer clean = identify_with({}, 1);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Answer a = identify_with({0.02, 0.02, 0.01}, seed);
        EXPECT_EQ(a.end.fault, "") << "seed " << seed;
        ASSERT_EQ(a.results.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(a.results[i].inertia / clean.results[i].inertia, 1, 2e-4)
                << "seed " << seed << ": the axis may have waited a SYNC longer";
        EXPECT_GT(a.heard->report.lost, 0);
        EXPECT_GT(a.link.repeated_requests + a.link.repeated_syncs, 0);
        EXPECT_LT(std::fabs(a.drive.speed), 1e-3);
    }
}

// The references that were played are those of the experiment, in every row that was heard.
TEST(Node, AMoveIsStreamedExactly) {
    const Experiment move = parse_experiment("trapezoid:stroke=1,velocity=20,cycles=1");
    const Capture alone = simulate(system1(), move, 1);
    for (unsigned seed = 0; seed <= 2; ++seed) {
        const double share = seed == 0 ? 0 : 0.02;
        can::MemoryBus wire;
        FreeDrive drive(wire);
        const auto end = wire.end();
        can::FaultyBus bus(*end, {share, share, 0}, seed);
        Link link(bus, free_link());
        {
            Master master(link);
            EXPECT_EQ(master.move(move, {}).fault, "");
            master.finish();
        }
        const auto heard = link.telemetry().captures("memory");
        const Capture& c = heard.captures.front();
        const double step = 2 * M_PI / 131072 / 256;
        if (seed == 0) {
            ASSERT_GE(c.rows(), alone.rows());
            for (std::size_t i = 0; i < alone.rows(); ++i) {
                ASSERT_NEAR(c.position_ref[i], alone.position_ref[i], step);
                ASSERT_NEAR(c.position[i], alone.position[i], 3 * 256 * step) << i;
            }
        }
        EXPECT_LT(std::fabs(drive.stop().speed), 1e-3);
    }
}

TEST(Node, AnotherMasterIsRefusedAndSeen) {
    can::MemoryBus wire;
    FreeDrive drive(wire);
    const auto one = wire.end(), two = wire.end();
    Link first(*one, free_link()), second(*two, free_link());
    Master owner(first);
    try {
        Master other(second);
        FAIL() << "claimed twice";
    } catch (const can::BusError& e) {
        EXPECT_NE(std::string(e.what()).find("another master"), std::string::npos) << e.what();
    }
    first.pump(std::chrono::milliseconds(1));
    EXPECT_GT(first.report().foreign_requests, 0);
}

TEST(Node, ASilentNodeIsSaid) {
    can::MemoryBus wire;
    const auto end = wire.end();
    LinkOptions options = free_link();
    options.answer_ms = 5, options.tries = 3;
    Link link(*end, options);
    try {
        Master master(link);
        FAIL() << "no drive there";
    } catch (const can::BusError& e) {
        EXPECT_NE(std::string(e.what()).find("node 1 does not answer"), std::string::npos);
        EXPECT_EQ(e.code(), ExitCode::bus_fault);
    }
    EXPECT_EQ(link.report().repeated_requests, 2);
}

// A reset in the middle: the axis was held, the run is no answer.
TEST(Node, AResetDuringARunIsAFault) {
    can::MemoryBus wire;
    FreeDrive drive(wire);
    const auto end = wire.end(), saboteur = wire.end();
    LinkOptions options = free_link();
    long asked = 0;
    options.cancelled = [&] {
        if (++asked == 12) {
            can::Frame nmt;
            nmt.id = 0, nmt.length = 2, nmt.data[0] = 0x81, nmt.data[1] = 1;
            saboteur->send(nmt);
        }
        return false;
    };
    Link link(*end, options);
    RunEnd ended;
    {
        Master master(link);
        ended = master.identify({{20, 1.0}}, {}, {});
    }
    EXPECT_NE(ended.fault.find("reset"), std::string::npos) << ended.fault;
    const NodeReport report = drive.stop();
    EXPECT_EQ(report.resets, 1);
    EXPECT_LT(std::fabs(report.speed), 1e-3);
}

// A master that falls silent in the middle: a drive in real time holds its axis by itself.
TEST(Node, ADriveWhoseMasterDiesComesToRest) {
    can::MemoryBus wire;
    const auto drive_end = wire.end();
    NodeOptions options;
    options.master_timeout_ms = 150;
    SimulatedNode node(system1(), options, *drive_end);
    std::jthread thread(
        [&](std::stop_token stop) { node.run([&] { return stop.stop_requested(); }); });
    const auto end = wire.end();
    Link link(*end, {});
    link.write(0x2A01, 1, 7, 4);        // claim
    link.write(0x2A05, 1, 20000000, 4); // 20 Hz
    link.write(0x2A06, 1, 5000000, 4);  // 20000 counts
    link.write(0x2A03, 1, 1, 1);        // one leg
    link.write(0x2A01, 4, 1, 4);        // start
    link.pump(std::chrono::milliseconds(100));
    EXPECT_EQ(link.read(0x2A02, 1), std::uint32_t(SID_STATE_MEASURING));
    std::this_thread::sleep_for(std::chrono::milliseconds(200)); // dead
    thread.request_stop();
    thread.join();
    const NodeReport report = node.report();
    EXPECT_EQ(report.reason, SID_MASTER_LOST);
    EXPECT_TRUE(report.held);
    EXPECT_GE(report.held_after, 150 * 8);
    EXPECT_LE(report.held_after, 150 * 8 + 3) << "control periods";
    EXPECT_LT(std::fabs(report.speed), 1e-3);
}

TEST(Node, TwoDrivesOfOneNumberAreRefused) {
    can::MemoryBus wire;
    const auto first_end = wire.end(), second_end = wire.end();
    SimulatedNode first(system1(), {}, *first_end);
    std::jthread thread(
        [&](std::stop_token stop) { first.run([&] { return stop.stop_requested(); }); });
    NodeOptions other;
    other.node = 2;
    EXPECT_NO_THROW(SimulatedNode(system1(), other, *second_end));
    EXPECT_THROW(SimulatedNode(system1(), {}, *second_end), can::BusError);
}

} // namespace servoid
