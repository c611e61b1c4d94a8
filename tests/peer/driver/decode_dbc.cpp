// Decodes frames as a DBC file says, for comparison with another program's decoding.
//
//   servoid_decode_dbc FILE.dbc <FRAMES
//
// A frame a line, `181#0102` (3 digits: 11 bit) or `18FF1234#0102` (8 digits: 29 bit). For each
// come its signals, without multiplexed ones, `N SIGNAL RAW VALUE`, N being the frame's line, and
// then `N = HEX`: what putting all these raw numbers into a frame of zeros gives.
#include "can/dbc.hpp"
#include "common/error.hpp"

#include <cinttypes>
#include <cstdio>
#include <iostream>
#include <map>

using namespace servoid::can;

namespace {

Frame parse_frame(const std::string& line) {
    const auto hash = line.find('#');
    Frame frame;
    frame.extended = hash == 8;
    frame.id = static_cast<std::uint32_t>(std::stoul(line.substr(0, hash), nullptr, 16));
    for (size_t at = hash + 1; at + 1 < line.size(); at += 2)
        frame.data.at(frame.length++) =
            static_cast<std::uint8_t>(std::stoul(line.substr(at, 2), nullptr, 16));
    return frame;
}

void decode(const DbcMessage& message, const Frame& frame, long number) {
    Frame again;
    for (const DbcSignal& signal : message.signals) {
        if (signal.multiplexed) continue;
        const Field& field = signal.field;
        const std::int64_t raw = raw_of(field, frame);
        put_raw(field, raw, again);
        std::printf("%ld %s ", number, field.name.c_str());
        if (field.kind == FieldKind::signed_integer)
            std::printf("%" PRId64, raw);
        else
            std::printf("%" PRIu64, static_cast<std::uint64_t>(raw));
        std::printf(" %.17g\n", value_of(field, frame));
    }
    std::printf("%ld = ", number);
    for (int i = 0; i < message.bytes; ++i)
        std::printf("%02x", again.data[static_cast<size_t>(i)]);
    std::printf("\n");
}

void decode_all(const Dbc& dbc) {
    std::map<FrameId, const DbcMessage*> messages;
    for (const auto& [name, message] : dbc.messages)
        messages[message.frame] = &message;
    std::string line;
    for (long number = 1; std::getline(std::cin, line); ++number) {
        const Frame frame = parse_frame(line);
        decode(*messages.at(id_of(frame)), frame, number);
    }
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: servoid_decode_dbc FILE.dbc <FRAMES\n");
        return 2;
    }
    try {
        decode_all(read_dbc(arguments[1]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
