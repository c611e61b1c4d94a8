// Logs of candump: every kind of mistake, and lines of any bytes.
#include "common/text.hpp"
#include "unit/candump_helpers.hpp"

#include <algorithm>
#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::can;

namespace {

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
