// Logs of candump: every kind of frame, every kind of mistake, and the way back.
#include "can/candump.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

using namespace servoid;
using namespace servoid::can;

namespace {

struct Log {
    std::vector<Frame> frames;
    std::vector<std::string> interfaces;
    std::uint64_t dropped = 0;
    bool truncated = false;
    long lines = 0;
};

Log read(std::string_view text) {
    CandumpReader reader(text, "drive.log");
    Log log;
    for (Frame frame; reader.next(frame);)
        log.frames.push_back(frame);
    log.interfaces = reader.interfaces();
    log.dropped = reader.dropped();
    log.truncated = reader.truncated();
    log.lines = reader.line();
    return log;
}

std::string message_of(std::string_view text) {
    try {
        read(text);
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

std::string line_of(const std::string& frame) { return "(1436509052.249713) can0 " + frame + "\n"; }

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

// --- mistakes ----------------------------------------------------------------------------------

struct Mistake {
    std::string line, message;
};

TEST(Candump, EveryMistakeIsSaidWithItsLine) {
    const std::string time = "(1436509052.249713) ", like = "; expected a line such as "
                                                            "(1436509052.249713) can0 181#0102";
    const Mistake mistakes[] = {
        {"hello", "\"hello\" is no frame" + like},
        {"can0  181   [2]  01 02", "\"can0  181   [2]  01 02\" is no frame" + like},
        {"DROPPED", "\"DROPPED\" is no frame" + like},
        {"DROPCOUNT: dropped many CAN frames",
         "\"DROPCOUNT: dropped many CAN frames\" does not say how many frames; expected DROPCOUNT: "
         "dropped N CAN frames"},
        {"(1436509052.249713 can0 181#01", "no \")\" after the time" + like},
        {"(abc) can0 181#01", "time \"abc\" is no number of seconds; expected digits with up to 9 "
                              "decimals, such as 1436509052.249713"},
        {"() can0 181#01", "time \"\" is no number"},
        {"(1.) can0 181#01", "time \"1.\" is no number"},
        {"(.5) can0 181#01", "time \".5\" is no number"},
        {"(-1.5) can0 181#01", "time \"-1.5\" is no number"},
        {"(1.5e3) can0 181#01", "time \"1.5e3\" is no number"},
        {"(1.0123456789) can0 181#01", "time \"1.0123456789\" is no number"},
        {"(2024-12-27 03:34:56.916858) can0 181#01",
         "time \"2024-12-27 03:34:56.916858\" is no number"},
        {"(9223372036.0) can0 181#01",
         "time \"9223372036.0\" is out of range; expected at most 9223372035 s"},
        {"(18446744073709551616.0) can0 181#01", "time \"18446744073709551616.0\" is out of range"},
        {"(1.0)", "no interface after the time" + like},
        {"(1.0) ", "no interface after the time" + like},
        {"(1.0)can0 181#01", "no interface after the time" + like},
        {"(1.0) 181#01", "no interface before the frame \"181#01\"" + like},
        {"(1.0) 181#01 R", "no interface before the frame \"181#01\"" + like},
        {"(1.0) can0", "no frame after the interface" + like},
        {"(1.0) can\x01 181#01", "interface \"can?\" is no text; expected a name such as can0"},
        {"(1.0) can\xff 181#01", "interface \"can?\" is no text; expected a name such as can0"},
        {time + "can0 18101", "no \"#\" in the frame \"18101\"" + like},
        {time + "can0 181 # 01", "no \"#\" in the frame \"181\"" + like},
        {time + "can0 #01", "identifier \"\" has 0 digits; expected 3 (11 bit) or 8"},
        {time + "can0 18#01", "identifier \"18\" has 2 digits; expected 3 (11 bit) or 8"},
        {time + "can0 0181#01", "identifier \"0181\" has 4 digits; expected 3 (11 bit) or 8"},
        {time + "can0 123456789#01",
         "identifier \"123456789\" has 9 digits; expected 3 (11 bit) or 8"},
        {time + "can0 45123#81:00:12345678#11223344",
         "identifier \"45123\" has 5 digits: CAN XL is not supported; expected 3 or 8"},
        {time + "can0 1G1#01",
         "identifier \"1G1\" is no hexadecimal number; expected 3 or 8 digits"},
        {time + "can0 800#01",
         "identifier \"800\" is above 7FF; expected one of 11 bit, or 8 digits for 29 bit"},
        {time + "can0 40000000#01", "identifier \"40000000\" is above 1FFFFFFF; expected one of 29 "
                                    "bit, or 20000000 added to an error class"},
        {time + "can0 80000181#01", "identifier \"80000181\" is above 1FFFFFFF"},
        {time + "can0 20000080#R", "error frame \"20000080#R\" is marked as remote or FD; expected "
                                   "a classic one with data"},
        {time + "can0 20000080##0", "error frame \"20000080##0\" is marked as remote or FD"},
        {time + "can0 181#012", "data have an odd number of digits; expected two for each byte"},
        {time + "can0 181#012 R", "data have an odd number of digits; expected two for each byte"},
        {time + "can0 181##1012", "data have an odd number of digits; expected two"},
        {time + "can0 181#0x12",
         "\"x\" in the data is no hexadecimal digit; expected two for each byte"},
        {time + "can0 181#01GG", "\"G\" in the data is no hexadecimal digit"},
        {time + "can0 181#01..02", "\".\" in the data is no hexadecimal digit"},
        {time + "can0 181#01.", "\".\" in the data is no hexadecimal digit"},
        {time + "can0 181#01\x01", "\"?\" in the data is no hexadecimal digit"},
        {time + "can0 181#01\xc3\xa4", "\"?\" in the data is no hexadecimal digit"},
        {time + "can0 181#01_9", "\"_\" in the data is no hexadecimal digit"},
        {time + "can0 181#010203040506070809",
         "more than 8 bytes of data; expected at most 8, or \"##\" for an FD frame"},
        {time + "can0 181#01020304050607080", "more than 8 bytes of data; expected at most 8"},
        {time + "can0 181#0102030405060708_8", "length code \"8\" after \"_\"; expected 9 to F"},
        {time + "can0 181#0102030405060708_", "length code \"\" after \"_\"; expected 9 to F"},
        {time + "can0 181#0102030405060708_9A", "length code \"9A\" after \"_\"; expected 9 to F"},
        {time + "can0 181#R9",
         "remote frame asks for \"9\"; expected a length from 0 to 8, or none"},
        {time + "can0 181#RA", "remote frame asks for \"A\"; expected a length from 0 to 8"},
        {time + "can0 181#R12", "\"2\" after the length of a remote frame; expected none"},
        {time + "can0 181#R8_7", "length code \"7\" after \"_\"; expected 9 to F"},
        {time + "can0 181##", "no flags after \"##\"; expected a digit, as in 181##10102"},
        {time + "can0 181##G01", "no flags after \"##\"; expected a digit, as in 181##10102"},
        {time + "can0 181##1" + std::string(130, '0'),
         "more than 64 bytes of data; expected at most 64"},
        {time + "can0 181#01 02 03", "\"02 03\" after the frame; expected nothing, or R or T"},
        {time + "can0 181#01 RT", "\"RT\" after the frame; expected nothing, or R or T"},
        {time + "can0 181#01 R 5", "\"R 5\" after the frame; expected nothing, or R or T"},
    };
    for (const auto& mistake : mistakes)
        for (const char* end : {"\n", "\r\n"}) {
            const std::string message =
                message_of("# log\n" + line_of("181#01") + mistake.line + end + line_of("182#01"));
            EXPECT_EQ(message.substr(0, 13), "drive.log:3: ") << mistake.line;
            EXPECT_EQ(message.substr(13, mistake.message.size()), mistake.message);
        }
}

TEST(Candump, OnlyLengthsOfFdFramesAreTaken) {
    for (int bytes = 0; bytes <= 64; ++bytes) {
        const bool allowed = bytes <= 8 || bytes == 12 || bytes == 16 || bytes == 20 ||
                             bytes == 24 || bytes == 32 || bytes == 48 || bytes == 64;
        const std::string data(static_cast<size_t>(2 * bytes), 'A');
        const std::string message = message_of(line_of("181##1" + data));
        EXPECT_EQ(message, allowed ? "no error"
                                   : "drive.log:1: FD frame of " + std::to_string(bytes) +
                                         " bytes; expected 0 to 8, 12, 16, 20, 24, 32, 48 or 64");
    }
}

TEST(Candump, MoreInterfacesThanANumberHoldsAreRefused) {
    std::string text;
    for (int i = 0; i < 256; ++i)
        text += "(1.0) can" + std::to_string(i) + " 181#\n";
    EXPECT_EQ(read(text).frames.back().interface, 255);
    EXPECT_EQ(message_of(text + "(1.0) can256 181#\n"),
              "drive.log:257: interface \"can256\" is one more than the 256 that are supported; "
              "expected fewer");
}

// --- whatever comes ----------------------------------------------------------------------------

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}
    std::uint64_t below(std::uint64_t n) {
        return std::uniform_int_distribution<std::uint64_t>(0, n - 1)(random_);
    }
    bool one_in(std::uint64_t n) { return below(n) == 0; }

    Frame frame() {
        Frame f;
        f.time_ns = static_cast<std::int64_t>(below(9'223'372'036'000'000'000));
        if (one_in(2)) f.time_ns -= f.time_ns % 1000;
        const auto kind = below(4);
        f.error = kind == 0;
        f.remote = kind == 1;
        f.fd = kind == 2;
        f.extended = !f.error && one_in(2);
        f.id = static_cast<std::uint32_t>(below(f.error || f.extended ? 0x20000000 : 0x800));
        static constexpr std::uint8_t lengths[] = {0, 1,  2,  3,  4,  5,  6,  7,
                                                   8, 12, 16, 20, 24, 32, 48, 64};
        f.length = lengths[below(f.fd ? 16 : 9)];
        if (f.fd) f.fd_flags = static_cast<std::uint8_t>(below(16));
        f.interface = static_cast<std::uint8_t>(below(3));
        for (size_t i = 0; !f.remote && i < f.length; ++i)
            f.data[i] = static_cast<std::uint8_t>(below(256));
        return f;
    }

  private:
    std::mt19937_64 random_;
};

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

bool printable(const std::string& text) {
    return std::none_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f;
    });
}

// Lines of which a few bytes are others: read, or refused in words, and nothing else.
TEST(Candump, BrokenLinesAreReadOrRefusedInPrintableWords) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    int refused = 0;
    for (int i = 0; i < 50000; ++i) {
        std::string text = format_candump(draw.frame(), "can0") + "\n";
        for (auto changes = 1 + draw.below(4); changes > 0; --changes)
            text[draw.below(text.size())] = static_cast<char>(draw.below(256));
        const std::string message = message_of(text);
        refused += message != "no error";
        ASSERT_TRUE(printable(message) && is_utf8(message)) << message;
    }
    EXPECT_GT(refused, 10000);
}

TEST(Candump, GarbageIsRefusedInPrintableWords) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    for (int i = 0; i < 2000; ++i) {
        std::string text(1 + draw.below(300), '\0');
        for (char& c : text)
            c = static_cast<char>(draw.below(256));
        const std::string message = message_of("(1.0) can0 " + text + "\n");
        ASSERT_NE(message, "no error");
        ASSERT_TRUE(printable(message) && is_utf8(message)) << message;
    }
    EXPECT_EQ(message_of(std::string("\0\0\0\n", 4)).substr(0, 18), "drive.log:1: \"???\"");
}

TEST(Candump, VeryLongLinesAreRefusedInFewWords) {
    const std::string many(10'000'000, '1');
    for (const auto& text :
         {many, "(" + many, "(1." + many, "(1.0) " + many, "(1.0) can0 " + many,
          "(1.0) can0 181#" + many, "(1.0) can0 181##1" + many, "(1.0) can0 181#R" + many,
          "(1.0) can0 181#01 " + many, "DROPCOUNT: dropped " + many}) {
        const std::string message = message_of(text + "\n");
        EXPECT_NE(message, "no error") << text.substr(0, 30);
        EXPECT_LT(message.size(), 200u);
    }
}

} // namespace
