// SocketCan against the kernel's own virtual bus.
#include "can/socketcan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <vector>

using namespace servoid::can;
using namespace std::chrono_literals;

namespace {

Frame numbered(std::uint32_t number) {
    Frame frame;
    frame.id = 0x181, frame.length = 8;
    for (unsigned i = 0; i < 4; ++i)
        frame.data[i] = std::uint8_t(number >> (8 * i));
    return frame;
}

std::vector<Frame> all_of(Bus& bus) {
    std::vector<Frame> out;
    for (Frame frame; bus.receive(frame, 100ms);)
        out.push_back(frame);
    return out;
}

void ip(const std::string& command) {
    ASSERT_EQ(std::system(("PATH=$PATH:/usr/sbin ip link " + command).c_str()), 0);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

TEST(SocketCan, EveryKindOfFrameArrivesAsItWasSent) {
    SocketCan from("vcan0"), to("vcan0");
    std::vector<Frame> sent;
    for (bool extended : {false, true})
        for (bool fd : {false, true})
            for (std::uint8_t length : std::vector<std::uint8_t>{0, 1, 8, 12, 64}) {
                if (!fd && length > 8) continue;
                Frame frame;
                frame.id = extended ? 0x1ABCDEF0 : 0x7FF, frame.extended = extended;
                frame.fd = fd, frame.fd_flags = fd ? 1 : 0, frame.length = length;
                for (std::uint8_t i = 0; i < length; ++i)
                    frame.data[i] = std::uint8_t(0xA0 + i);
                sent.push_back(frame);
            }
    Frame remote;
    remote.id = 0x123, remote.remote = true, remote.length = 4;
    Frame error;
    error.id = 0x40, error.error = true, error.length = 8;
    sent.push_back(remote), sent.push_back(error);
    for (const Frame& frame : sent)
        from.send(frame);
    std::vector<Frame> heard = all_of(to);
    ASSERT_EQ(heard.size(), sent.size());
    for (std::size_t i = 0; i < heard.size(); ++i) {
        EXPECT_LT(std::abs(double(heard[i].time_ns) * 1e-9 - double(std::time(nullptr))), 60);
        heard[i].time_ns = 0;
        heard[i].fd_flags &= 3; // newer kernels mark what is FD
        EXPECT_EQ(heard[i], sent[i]) << i;
    }
    EXPECT_EQ(from.health().sent, long(sent.size()));
    EXPECT_EQ(to.health().received, long(sent.size()));
    EXPECT_EQ(to.health().bus_off, 1);
    EXPECT_TRUE(all_of(from).empty()) << "own frames are not received";
}

TEST(SocketCan, ListensToWhatItIsTold) {
    SocketCanOptions options;
    options.listen_to = {{0x181, false}, {0x181, true}};
    SocketCan from("vcan0"), to("vcan0", options);
    const auto send_all = [&] {
        for (std::uint32_t id : {0x180u, 0x181u, 0x182u})
            for (bool extended : {false, true}) {
                Frame frame;
                frame.id = id, frame.extended = extended;
                from.send(frame);
            }
    };
    const auto heard = [&] {
        std::string out;
        for (const Frame& frame : all_of(to))
            out += to_text(id_of(frame)) + " ";
        return out;
    };
    send_all();
    EXPECT_EQ(heard(), "0x181 0x00000181x ");
    to.listen_to({{0x182, false}, {0x180, true}});
    send_all();
    EXPECT_EQ(heard(), "0x00000180x 0x182 ");
    to.listen_to({});
    send_all();
    EXPECT_EQ(heard(), "0x180 0x00000180x 0x181 0x00000181x 0x182 0x00000182x ");
}

// In the kernel's queue and in ours: each frame was received or is counted as dropped.
TEST(SocketCan, WhatHadNoRoomIsCounted) {
    constexpr long count = 5000;
    SocketCanOptions small_kernel, small_queue;
    small_kernel.receive_buffer_bytes = 20000;
    small_queue.queue_frames = 100;
    SocketCan from("vcan0"), kernel("vcan0", small_kernel), queue("vcan0", small_queue);
    for (std::uint32_t i = 0; i < count; ++i)
        from.send(numbered(i));
    for (SocketCan* to : {&kernel, &queue}) {
        const long received = long(all_of(*to).size());
        EXPECT_EQ(to->health().received, received);
        EXPECT_EQ(received + to->health().dropped, count);
        EXPECT_GT(to->health().dropped, 1000);
        EXPECT_GT(received, 5);
    }
    EXPECT_EQ(all_of(queue).size(), 0u);
}

// In bursts that fit into what the kernel grants to anybody.
TEST(SocketCan, NothingIsDroppedWhereThereIsRoom) {
    constexpr std::uint32_t count = 20000, burst = 100;
    SocketCan from("vcan0"), to("vcan0");
    double sending_s = 0, receiving_s = 0;
    for (std::uint32_t first = 0; first < count; first += burst) {
        const auto start = std::chrono::steady_clock::now();
        for (std::uint32_t i = 0; i < burst; ++i)
            from.send(numbered(first + i));
        sending_s += seconds_since(start);
        const auto sent = std::chrono::steady_clock::now();
        Frame frame;
        for (std::uint32_t i = 0; i < burst; ++i) {
            ASSERT_TRUE(to.receive(frame, 1s));
            ASSERT_EQ(frame.data, numbered(first + i).data);
        }
        receiving_s += seconds_since(sent);
    }
    EXPECT_EQ(to.health().received, long(count));
    EXPECT_EQ(to.health().dropped, 0);
    fmt::print("figure: SocketCan on a virtual bus: {:.3g} frames/s sent, {:.3g} frames/s received "
               "from the kernel's queue, 0 of {} dropped\n",
               count / sending_s, count / receiving_s, count);
}

TEST(SocketCan, AnInterfaceThatIsDownIsWaitedFor) {
    SocketCanOptions options;
    options.trouble_wait = 300ms;
    SocketCan from("vcan1"), to("vcan1", options);
    from.send(numbered(1));
    ip("set vcan1 down");
    Frame frame;
    EXPECT_TRUE(to.receive(frame, 0s)) << "what came before is given first";
    EXPECT_FALSE(to.receive(frame, 100ms));
    ip("set vcan1 up");
    EXPECT_FALSE(to.receive(frame, 500ms)) << "it is up again";
    from.send(numbered(2));
    EXPECT_TRUE(to.receive(frame, 1s));
    EXPECT_EQ(to.health().interface_down, 1);
    ip("set vcan1 down");
    from.send(numbered(3));
    EXPECT_EQ(from.health().not_sent, 1);
    EXPECT_THROW(to.receive(frame, 10s), BusError);
    ip("set vcan1 up");
}

TEST(SocketCan, AnInterfaceThatIsGoneGaveItsFrames) {
    ip("add dev vcan2 type vcan && ip link set vcan2 up");
    SocketCan from("vcan2"), to("vcan2");
    from.send(numbered(1)), from.send(numbered(2));
    ip("del vcan2");
    Frame frame;
    EXPECT_TRUE(to.receive(frame, 0s));
    EXPECT_TRUE(to.receive(frame, 0s));
    EXPECT_THROW(to.receive(frame, 0s), BusError);
    EXPECT_THROW(from.send(numbered(3)), BusError);
}

TEST(SocketCan, BusOffEndsWithDataOrARestart) {
    SocketCanOptions options;
    options.trouble_wait = 200ms;
    SocketCan from("vcan0"), to("vcan0", options);
    Frame off, restarted, frame;
    off.id = 0x40, off.error = true, off.length = 8;
    restarted.id = 0x100, restarted.error = true, restarted.length = 8;
    for (const Frame& back : {restarted, numbered(1)}) {
        from.send(off), from.send(back);
        EXPECT_EQ(all_of(to).size(), 2u);
        EXPECT_FALSE(to.receive(frame, 400ms));
    }
    from.send(off);
    EXPECT_TRUE(to.receive(frame, 1s));
    EXPECT_THROW(to.receive(frame, 10s), BusError);
    EXPECT_EQ(to.health().bus_off, 3);
    EXPECT_EQ(to.health().restarted, 1);
}

TEST(SocketCan, FdWhereTheInterfaceHasNone) {
    ip("set vcan1 down && ip link set vcan1 mtu 16 && ip link set vcan1 up");
    SocketCan from("vcan1");
    Frame frame;
    frame.fd = true, frame.length = 12;
    EXPECT_THROW(from.send(frame), BusError);
    frame.fd = false, frame.length = 8;
    from.send(frame);
    EXPECT_EQ(from.health().sent, 1);
    ip("set vcan1 down && ip link set vcan1 mtu 72 && ip link set vcan1 up");
}
