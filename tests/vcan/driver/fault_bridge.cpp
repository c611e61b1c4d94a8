// Joins two CAN interfaces by a bad cable: frames are lost, repeated, overtaken, late or cut short.
//
//   fault_bridge MASTERS_SIDE DRIVES_SIDE [--lose %] [--repeat %] [--reorder %] [--cut %]
//                [--delay MS] [--seed N] [--at TELEMETRY_FRAMES COMMAND]...
//
// Each fault strikes each frame with its own probability, in both directions alike; the delay is
// drawn anew for each frame, up to MS, and keeps the order. --at runs a command of the shell once
// so many frames of a run's telemetry have passed, and nothing passes until it has ended. SIGTERM
// ends it; then it says on stdout what it has done.
#include "can/bus.hpp"
#include "can/can_socket.hpp"

#include <fmt/format.h>

#include <linux/can.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <random>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

volatile std::sig_atomic_t ended = 0;

struct Faults {
    double lose = 0, repeat = 0, reorder = 0, cut = 0; // %
    int delay_ms = 0;
    unsigned seed = 1;
};

struct Trigger {
    long telemetry_frames;
    std::string command;
};

struct Counts {
    long passed = 0, lost = 0, repeated = 0, overtaken = 0, cut = 0, refused = 0;
};

struct Wire {
    canfd_frame frame{};
    std::size_t bytes = 0; // CAN_MTU or CANFD_MTU
    Clock::time_point due;
    int overtakers = 0; // so many frames go first
};

// An FD frame has only some lengths.
std::uint8_t shorter(std::uint8_t length, std::mt19937& random) {
    static constexpr std::array<std::uint8_t, 16> lengths = {0, 1,  2,  3,  4,  5,  6,  7,
                                                             8, 12, 16, 20, 24, 32, 48, 64};
    const auto below = std::lower_bound(lengths.begin(), lengths.end(), length) - lengths.begin();
    if (below == 0) return 0;
    return lengths[std::size_t(std::uniform_int_distribution<long>(0, below - 1)(random))];
}

// Samples of telemetry that say that something runs (SPEC.md, "Telemetry").
bool is_of_a_run(const canfd_frame& frame) {
    return (frame.can_id & ~0x7FU) == 0x480 && frame.len == 64 && frame.data[0] == 1 &&
           (frame.data[63] == 1 || frame.data[63] == 2);
}

// One direction.
class Lane {
  public:
    Lane(int from, int to, const Faults& faults, unsigned salt)
        : from_(from), to_(to), faults_(faults), random_(faults.seed * 2 + salt) {}
    int from() const { return from_; }
    const Counts& counts() const { return counts_; }

    // Takes what has come; returns how many frames of telemetry were among it.
    long take() {
        long telemetry = 0;
        Wire wire;
        const auto now = Clock::now();
        for (int i = 0; i < 64; ++i) {
            const ssize_t got = ::read(from_, &wire.frame, sizeof wire.frame);
            if (got <= 0) break;
            if (wire.frame.can_id & CAN_ERR_FLAG) continue; // each wire has its own errors
            wire.bytes = std::size_t(got);
            telemetry += is_of_a_run(wire.frame);
            wire.due = now;
            strike(wire);
            pass(now);
        }
        return telemetry;
    }

    void pass(Clock::time_point now) {
        while (!queue_.empty() && queue_.front().due <= now) {
            write(queue_.front());
            queue_.pop_front();
        }
        for (std::size_t i = 0; i < held_.size();) {
            if (held_[i].overtakers > 0 && held_[i].due > now) {
                ++i;
                continue;
            }
            write(held_[i]);
            held_.erase(held_.begin() + long(i));
        }
    }

    // Until the next frame is due.
    milliseconds wait() const {
        if (queue_.empty() && held_.empty()) return milliseconds(100);
        auto next = Clock::now() + milliseconds(100);
        if (!queue_.empty()) next = std::min(next, queue_.front().due);
        for (const Wire& one : held_)
            next = std::min(next, one.due);
        const auto left = std::chrono::ceil<milliseconds>(next - Clock::now());
        return std::max(left, milliseconds(0));
    }

  private:
    bool strikes(double percent) {
        return percent > 0 && std::uniform_real_distribution<>(0, 100)(random_) < percent;
    }

    void strike(Wire wire) {
        if (strikes(faults_.lose)) {
            ++counts_.lost;
            return;
        }
        if (strikes(faults_.cut)) {
            ++counts_.cut;
            wire.frame.len = shorter(wire.frame.len, random_);
        }
        if (strikes(faults_.reorder)) {
            ++counts_.overtaken;
            wire.overtakers = std::uniform_int_distribution<>(1, 3)(random_);
            wire.due += milliseconds(5); // nobody came to overtake it
            held_.push_back(wire);
            return;
        }
        if (faults_.delay_ms > 0)
            wire.due += std::chrono::microseconds(
                std::uniform_int_distribution<>(0, 1000 * faults_.delay_ms)(random_));
        if (!queue_.empty()) wire.due = std::max(wire.due, queue_.back().due);
        queue_.push_back(wire);
        for (Wire& one : held_)
            --one.overtakers;
        if (!strikes(faults_.repeat)) return;
        ++counts_.repeated;
        queue_.push_back(wire);
    }

    void write(const Wire& wire) {
        const bool done = ::write(to_, &wire.frame, wire.bytes) == ssize_t(wire.bytes);
        ++(done ? counts_.passed : counts_.refused);
    }

    int from_, to_;
    Faults faults_;
    std::mt19937 random_;
    std::deque<Wire> queue_;
    std::vector<Wire> held_;
    Counts counts_;
};

struct Options {
    Faults faults;
    std::vector<std::string> interfaces;
    std::vector<Trigger> triggers;
};

Options parse(const std::vector<std::string>& words) {
    Options out;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const auto next = [&] { return words.at(++i); };
        if (word == "--lose")
            out.faults.lose = std::stod(next());
        else if (word == "--repeat")
            out.faults.repeat = std::stod(next());
        else if (word == "--reorder")
            out.faults.reorder = std::stod(next());
        else if (word == "--cut")
            out.faults.cut = std::stod(next());
        else if (word == "--delay")
            out.faults.delay_ms = std::stoi(next());
        else if (word == "--seed")
            out.faults.seed = unsigned(std::stoul(next()));
        else if (word == "--at") {
            const long frames = std::stol(next());
            out.triggers.push_back({frames, next()});
        } else
            out.interfaces.push_back(word);
    }
    if (out.interfaces.size() != 2) throw std::invalid_argument("two interfaces are needed");
    return out;
}

void say(const char* name, const Counts& c) {
    fmt::print("bridge, {}: {} passed, {} lost, {} repeated, {} overtaken, {} cut short, {} found "
               "no interface\n",
               name, c.passed, c.lost, c.repeated, c.overtaken, c.cut, c.refused);
}

void run(const Options& o) {
    const int masters = servoid::can::open_can_socket(o.interfaces[0], {}, 8 << 20);
    const int drives = servoid::can::open_can_socket(o.interfaces[1], {}, 8 << 20);
    Lane down(masters, drives, o.faults, 0), up(drives, masters, o.faults, 1);
    fmt::print("bridge, seed {}: ready\n", o.faults.seed);
    std::fflush(stdout);
    long telemetry = 0;
    std::size_t next = 0;
    while (ended == 0) {
        std::array<pollfd, 2> both{pollfd{masters, POLLIN, 0}, pollfd{drives, POLLIN, 0}};
        ::poll(both.data(), both.size(), int(std::min(down.wait(), up.wait()).count()));
        down.take(), telemetry += up.take();
        const auto now = Clock::now();
        down.pass(now), up.pass(now);
        while (next < o.triggers.size() && telemetry >= o.triggers[next].telemetry_frames)
            if (std::system(o.triggers[next++].command.c_str()) != 0)
                fmt::print("bridge: `{}` failed\n", o.triggers[next - 1].command);
    }
    say("to the drive", down.counts()), say("to the master", up.counts());
}

} // namespace

int main(int argc, char** argv) try {
    std::signal(SIGTERM, [](int) { ended = 1; });
    run(parse({argv + 1, argv + argc}));
} catch (const std::exception& e) {
    fmt::print(stderr, "fault_bridge: {}\n", e.what());
    return 2;
}
