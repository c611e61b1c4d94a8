// Logs of candump: every kind of frame, logs that break off, and the way back.
#include "unit/candump_helpers.hpp"

#include <algorithm>
#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::can;

namespace {

Frame one(const std::string& frame) {
    const Log log = read(line_of(frame));
    EXPECT_EQ(log.frames.size(), 1u) << frame;
    return log.frames.empty() ? Frame{} : log.frames.front();
}

Frame standard(std::uint32_t id, std::initializer_list<std::uint8_t> data = {}) {
    Frame frame;
    frame.time_ns = 1436509052249713000;
    frame.id = id;
    frame.length = static_cast<std::uint8_t>(data.size());
    std::copy(data.begin(), data.end(), frame.data.begin());
    return frame;
}

Frame extended(std::uint32_t id, std::initializer_list<std::uint8_t> data = {}) {
    Frame frame = standard(id, data);
    frame.extended = true;
    return frame;
}

Frame remote(Frame frame, std::uint8_t length = 0) {
    frame.remote = true;
    frame.length = length;
    return frame;
}

Frame fd(Frame frame, std::uint8_t flags) {
    frame.fd = true;
    frame.fd_flags = flags;
    return frame;
}

Frame error_frame(std::uint32_t error_class, std::initializer_list<std::uint8_t> data) {
    Frame frame = standard(error_class, data);
    frame.error = true;
    return frame;
}

TEST(FrameId, TextSaysWhichKind) {
    EXPECT_EQ(to_text({0x181, false}), "0x181");
    EXPECT_EQ(to_text({0x18FF1234, true}), "0x18FF1234x");
    EXPECT_EQ(to_text({0x1, false}), "0x001");
    EXPECT_EQ(to_text({0x1, true}), "0x00000001x");
}

// The examples that can-utils' lib.h gives for parse_canframe(), all of them but those of CAN XL.
TEST(Candump, EveryExampleOfCanUtilsIsRead) {
    const std::initializer_list<std::uint8_t> eight = {0x11, 0x22, 0x33, 0x44,
                                                       0x55, 0x66, 0x77, 0x88};
    EXPECT_EQ(one("123#"), standard(0x123));
    EXPECT_EQ(one("12345678#"), extended(0x12345678));
    EXPECT_EQ(one("123#R"), remote(standard(0x123)));
    EXPECT_EQ(one("123#R0"), remote(standard(0x123)));
    EXPECT_EQ(one("123#R7"), remote(standard(0x123), 7));
    EXPECT_EQ(one("123#R8_9"), remote(standard(0x123), 8));
    EXPECT_EQ(one("7A1#r"), remote(standard(0x7a1)));
    EXPECT_EQ(one("123#00"), standard(0x123, {0}));
    EXPECT_EQ(one("123#1122334455667788"), standard(0x123, eight));
    EXPECT_EQ(one("123#1122334455667788_E"), standard(0x123, eight));
    EXPECT_EQ(one("123#11.22.33.44.55.66.77.88"), standard(0x123, eight));
    EXPECT_EQ(one("123#11.2233.44556677.88"), standard(0x123, eight));
    EXPECT_EQ(one("32345678#112233"), error_frame(0x12345678, {0x11, 0x22, 0x33}));
    EXPECT_EQ(one("123##0112233"), fd(standard(0x123, {0x11, 0x22, 0x33}), 0));
    EXPECT_EQ(one("123##1112233"), fd(standard(0x123, {0x11, 0x22, 0x33}), 1));
    EXPECT_EQ(one("123##2112233"), fd(standard(0x123, {0x11, 0x22, 0x33}), 2));
    EXPECT_EQ(one("123##3"), fd(standard(0x123), 3));
}

// A log of `candump -L` that https://elinux.org/Bringing_CAN_interface_up shows, one of an FD frame
// from a kernel that sets FDF (the socketcan crate's CanDumpLogFormat.md), and an error frame as
// lib.h shows it: read and written again, they are the same bytes.
TEST(Candump, LogsOfCandumpComeBackAsTheyWere) {
    const std::string lines[] = {
        "(1436509052.249713) vcan0 044#2A366C2BBA",
        "(1436509052.449847) vcan0 0F6#7ADFE07BD2",
        "(1436509052.650004) vcan0 236#C3406B09F4C88036",
        "(1436509053.050284) vcan0 17F#C7",
        "(1735270588.936508) can0 120##500112233445566778899AABB",
        "(1735279041.257318) can1 104#R",
        "(1735279048.349278) can1 110#R4",
        "(1469439874.299654) can1 104#",
        "(0000000012.000001) can0 12345678#112233",
        "(0000000012.000001) can0 20000080#0000000000000000",
    };
    for (const auto& line : lines) {
        const Log log = read(line + "\n");
        ASSERT_EQ(log.frames.size(), 1u) << line;
        EXPECT_EQ(format_candump(log.frames[0], log.interfaces[0]), line);
    }
}

TEST(Candump, TimesAreExact) {
    const auto time_of = [](const std::string& time) {
        const Log log = read("(" + time + ") can0 1FF#\n");
        return log.frames.empty() ? -1 : log.frames[0].time_ns;
    };
    EXPECT_EQ(time_of("1436509052.249713"), 1436509052249713000);
    EXPECT_EQ(time_of("1436509052.249713001"), 1436509052249713001);
    EXPECT_EQ(time_of("000.000000"), 0);
    EXPECT_EQ(time_of("003.000125"), 3000125000); // candump -t z
    EXPECT_EQ(time_of("0.0"), 0);                 // python-can's own example
    EXPECT_EQ(time_of("7"), 7000000000);
    EXPECT_EQ(time_of("9223372035.999999999"), 9223372035999999999);
}

TEST(Candump, TimesOfNanosecondsKeepThem) {
    Frame frame = standard(0x1ff);
    frame.time_ns = 1436509052249713001;
    EXPECT_EQ(format_candump(frame, "can0"), "(1436509052.249713001) can0 1FF#");
}

TEST(Candump, LowerCaseAndDirectionsAreRead) {
    EXPECT_EQ(one("7ff#abcdef"), standard(0x7ff, {0xab, 0xcd, 0xef}));
    EXPECT_EQ(one("18ff12ab##fAbCd"), fd(extended(0x18ff12ab, {0xab, 0xcd}), 15));
    for (const char* direction : {" R", " T", " r", "  T ", "\tR", " "})
        EXPECT_EQ(one(std::string("181#01") + direction), standard(0x181, {1})) << direction;
    EXPECT_EQ(one("181#R R"), remote(standard(0x181)));
}

TEST(Candump, InterfacesAreNumberedAsTheyCome) {
    // candump pads names to the longest it has seen
    const Log log =
        read("(1.0)  can1 181#\n(1.1) vcan0 181#\n(1.2)  can1 181#\n(1.3)     8 181#\n");
    EXPECT_EQ(log.interfaces, (std::vector<std::string>{"can1", "vcan0", "8"}));
    ASSERT_EQ(log.frames.size(), 4u);
    EXPECT_EQ(log.frames[0].interface, 0);
    EXPECT_EQ(log.frames[1].interface, 1);
    EXPECT_EQ(log.frames[2].interface, 0);
    EXPECT_EQ(log.frames[3].interface, 2);
}

TEST(Candump, EveryLineEndIsTaken) {
    const Log log =
        read("\xef\xbb\xbf# a comment\r\n\r\n(1.0) can0 181#01\r\n \t\n(2.0) can0 182#\n");
    ASSERT_EQ(log.frames.size(), 2u);
    EXPECT_EQ(log.frames[0].length, 1);
    EXPECT_EQ(log.frames[1].id, 0x182u);
    EXPECT_EQ(log.lines, 5);
    EXPECT_FALSE(log.truncated);
    EXPECT_TRUE(read("").frames.empty());
    EXPECT_FALSE(read("").truncated);
}

// candump.c writes this line into its log where the socket lost frames (option -d).
TEST(Candump, FramesThatWereDroppedAreCounted) {
    const std::string first = "DROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 1)\n";
    const std::string second =
        "DROPCOUNT: dropped 12 CAN frames on 'can0' socket (total drops 13)\n";
    const Log log = read(first + line_of("181#01") + second);
    EXPECT_EQ(log.frames.size(), 1u);
    EXPECT_EQ(log.dropped, 13u);
}

// --- a log that breaks off ---------------------------------------------------------------------

TEST(Candump, ALogMayBreakOffAnywhere) {
    const std::string whole = line_of("181#01");
    for (const char* frame : {"12345678#0102", "181##5000102030405060708090A0B", "181#R8_F",
                              "181#0102030405060708_9", "20000080#0000000000000000", "181#01 T"}) {
        const std::string last = line_of(frame);
        for (size_t length = 1; length < last.size(); ++length) {
            const std::string cut = last.substr(0, length);
            const Log log = read(whole + cut);
            EXPECT_TRUE(log.truncated) << cut;
            ASSERT_GE(log.frames.size(), 1u);
            ASSERT_LE(log.frames.size(), 2u);
            EXPECT_EQ(log.interfaces, std::vector<std::string>{"can0"}) << cut;
        }
        EXPECT_FALSE(read(whole + last).truncated);
    }
    const std::string dropped = "DROPCOUNT: dropped 7 CAN frames";
    for (size_t length = 1; length < dropped.size(); ++length)
        EXPECT_TRUE(read(whole + dropped.substr(0, length)).truncated) << length;
}

TEST(Candump, AWholeLastLineWithoutEndIsGiven) {
    const Log log = read(line_of("181#01") + "(2.0) can0 182#0203");
    ASSERT_EQ(log.frames.size(), 2u);
    EXPECT_EQ(log.frames[1].id, 0x182u);
    EXPECT_TRUE(log.truncated);
}

TEST(Candump, ALastLineThatWasNoFrameIsAnError) {
    for (const char* last :
         {"hello", "(1.0) can0 181#0102030405060708FF", "(1.0x", "(1.0) can0 18G#"})
        EXPECT_NE(message_of(line_of("181#01") + last), "no error") << last;
}

// --- there and back -----------------------------------------------------------------------------

const std::string names[] = {"can0", "vcan1", "8"};

TEST(Candump, RandomFramesComeBackTheSame) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    for (int i = 0; i < 20000; ++i) {
        Frame frame = draw.frame();
        const std::string text = format_candump(frame, names[frame.interface]);
        const Log log = read(text + "\n");
        ASSERT_EQ(log.frames.size(), 1u) << text;
        ASSERT_EQ(log.interfaces[0], names[frame.interface]) << text;
        frame.interface = 0; // the only one of its log
        ASSERT_EQ(log.frames[0], frame) << text;
    }
}

TEST(Candump, RandomLogsComeBackTheSame) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    std::string text;
    for (const auto& name : names) // in their order
        text += "(0.0) " + name + " 000#\n";
    std::vector<Frame> frames;
    for (int i = 0; i < 5000; ++i) {
        frames.push_back(draw.frame());
        text += format_candump(frames.back(), names[frames.back().interface]) + "\n";
    }
    Log log = read(text);
    log.frames.erase(log.frames.begin(), log.frames.begin() + 3);
    EXPECT_TRUE(log.frames == frames);
}

} // namespace
