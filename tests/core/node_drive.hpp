// A simulated drive behind sid_node, and the words of a master: what the tests of the node share.
#pragma once

#include "support.hpp"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <optional>

struct NodeDrive {
    static constexpr uint8_t kNode = 5, kMaster = 127;
    Axis axis = system_1();
    sid_loop_t loop{};
    sid_node_t node{};
    sid_node_config_t config{};
    std::vector<sid_frequency_t> plan{4};
    std::vector<sid_result_t> results{4};
    std::vector<sid_row_t> rows{256};
    std::vector<int32_t> references = std::vector<int32_t>(1024);
    std::vector<sid_can_frame_t> sent;
    int32_t torque = 0;
    sid_command_t command{};
    std::function<void(sid_sample_t&)> fault = [](sid_sample_t&) {};

    NodeDrive() {
        rows.resize(256), plan.resize(4), results.resize(4);
        config.axis.sample_rate_uHz = 8000000000U;
        config.axis.rated_torque = scaled(axis.rated_Nm);
        config.axis.count = scaled(axis.count_rad());
        config.axis.encoder_increments = 131072, config.axis.encoder_revolutions = 1;
        config.identify.results = results.data();
        config.identify.position_bits = 17;
        config.identify.torque_timing = SID_TORQUE_HELD_LAST;
        config.identify.torque_limit_pu_q20 = 3 << 20;
        config.identify.stroke_limit_count = 60000;
        config.plan = plan.data(), config.plan_capacity = 4;
        config.node_id = kNode, config.master_id = kMaster;
        config.master_timeout_ms = 100, config.heartbeat_ms = 50;
        config.rows = rows.data(), config.row_count = 256;
        config.references = references.data(), config.reference_count = 1024;
    }
    bool begin() {
        const sid_loop_config_t c = paper_loop(axis);
        EXPECT_TRUE(sid_loop_init(&loop, &c));
        sid_loop_reset(&loop, int32_t(axis.count()));
        if (!sid_node_init(&node, &config)) return false;
        step(1);
        return true;
    }
    void interrupt() {
        sid_sample_t in = {axis.raw(), torque};
        fault(in);
        sid_node_step(&node, &in, &command);
        const int32_t zero = int32_t(node.run.start_raw << 8);
        torque = sid_loop_step(&loop, zero + command.reference_q8, int32_t(axis.count()));
        axis.advance(torque / 1048576.0 * axis.rated_Nm);
    }
    void background() {
        sid_can_frame_t frame;
        while (sid_node_poll(&node, 64, &frame))
            sent.push_back(frame);
    }
    void step(int samples, bool heartbeats = true) {
        for (int i = 0; i < samples; i++) {
            interrupt();
            if (heartbeats) heartbeat();
            background();
        }
    }
    void give(uint32_t id, std::vector<uint8_t> data) { (void)ask(id, std::move(data)); }
    void heartbeat() { give(SID_ID_HEARTBEAT + kMaster, {5}); }
    std::optional<sid_can_frame_t> ask(uint32_t id, std::vector<uint8_t> data) {
        sid_can_frame_t frame{}, answer{};
        frame.id = id, frame.length = uint8_t(data.size()), frame.fd = data.size() > 8;
        std::copy(data.begin(), data.end(), frame.data);
        if (!sid_node_receive(&node, &frame, &answer)) return std::nullopt;
        return answer;
    }
    // The abort code, 0 where it was taken.
    uint32_t write(uint16_t index, uint8_t sub, uint32_t value, int bytes) {
        const auto a =
            ask(SID_ID_REQUEST + kNode,
                {uint8_t(0x23 | (4 - bytes) << 2), uint8_t(index & 0xFF), uint8_t(index >> 8), sub,
                 uint8_t(value), uint8_t(value >> 8), uint8_t(value >> 16), uint8_t(value >> 24)});
        if (!a) return ~0U;
        EXPECT_EQ(a->id, SID_ID_ANSWER + kNode);
        return a->data[0] == 0x60 ? 0 : sid_get_u32(&a->data[4]);
    }
    sid_can_frame_t read(uint16_t index, uint8_t sub) {
        const auto a = ask(SID_ID_REQUEST + kNode,
                           {0x40, uint8_t(index & 0xFF), uint8_t(index >> 8), sub, 0, 0, 0, 0});
        EXPECT_TRUE(a);
        return a.value_or(sid_can_frame_t{});
    }
    uint32_t refusal(uint16_t index, uint8_t sub) { // of a read
        const sid_can_frame_t a = read(index, sub);
        return a.data[0] == 0x80 ? sid_get_u32(&a.data[4]) : 0;
    }
    uint32_t value_at(uint16_t index, uint8_t sub) {
        const sid_can_frame_t a = read(index, sub);
        EXPECT_EQ(a.data[0] & 0xF3, 0x43) << std::hex << index << ':' << int(sub);
        return sid_get_u32(&a.data[4]);
    }
    // What a master says before a session of one frequency.
    void plan_one(double frequency_Hz, double amplitude_rad, uint32_t run) {
        EXPECT_EQ(write(0x2A01, 1, 77, 4), 0U);
        EXPECT_EQ(write(0x2A05, 1, uint32_t(frequency_Hz * 1e6), 4), 0U);
        EXPECT_EQ(
            write(0x2A06, 1, uint32_t(std::lround(amplitude_rad / axis.count_rad() * 256)), 4), 0U);
        EXPECT_EQ(write(0x2A03, 1, 1, 1), 0U);
        EXPECT_EQ(write(0x2A01, 2, SID_RUN_IDENTIFY, 1), 0U);
        EXPECT_EQ(write(0x2A01, 4, run, 4), 0U);
    }
    void run_out(int most = 40000) {
        for (int i = 0; i < most && sid_node_is_running(&node); i++)
            step(1);
        EXPECT_FALSE(sid_node_is_running(&node));
    }
};

// Frame `index` of a move as the master streams it.
inline std::vector<uint8_t> reference_frame(const std::vector<int32_t>& move, uint32_t first,
                                            uint32_t count) {
    std::vector<uint8_t> data(8 + 4 * 14);
    data[0] = 1, data[1] = uint8_t(count);
    sid_put_u32(&data[4], first);
    for (uint32_t i = 0; i < count; i++)
        sid_put_u32(&data[8 + 4 * i], uint32_t(move[first + i]));
    return data;
}
