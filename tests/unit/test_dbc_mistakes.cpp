// DBC files: what is refused, and in which words.
#include "unit/dbc_helpers.hpp"

#include <cstdio>
#include <random>

using namespace servoid;
using namespace servoid::can;

namespace {

TEST(DbcErrors, NoDbc) {
    EXPECT_EQ(error_of(""), "a.dbc: holds no message; expected a DBC file, with BO_ lines");
    EXPECT_EQ(error_of("time_s,torque_Nm\n0,1\n"),
              "a.dbc: holds no message; expected a DBC file, with BO_ lines");
}

TEST(DbcErrors, Utf16) {
    EXPECT_EQ(error_of("\xff\xfe"
                       "B"),
              "a.dbc: is UTF-16 text; save it as UTF-8");
}

TEST(DbcErrors, StringNotClosed) {
    EXPECT_EQ(error_of("BO_ 1 A: 8 X\nCM_ \"several\nlines\n"),
              "a.dbc:2: a string is not closed; expected a second \"");
    EXPECT_EQ(error_of("BO_ 1 A: 8 X\n\nCM_ \"escaped \\\""),
              "a.dbc:3: a string is not closed; expected a second \"");
}

TEST(DbcErrors, Messages) {
    const std::string form = "; a message reads BO_ ID NAME: BYTES SENDER";
    EXPECT_EQ(error_of("\nBO_ x A: 8 X"),
              "a.dbc:2: has \"x\" where an identifier should be" + form);
    EXPECT_EQ(error_of("BO_ 99999999999 A: 8 X"),
              "a.dbc:1: has \"99999999999\" where an identifier should be" + form);
    EXPECT_EQ(error_of("BO_ 1 : 8 X"),
              "a.dbc:1: has \":\" where the message's name should be" + form);
    EXPECT_EQ(error_of("BO_ 1 A-B: 8 X"),
              "a.dbc:1: has \"A-B\" where the message's name should be" + form);
    EXPECT_EQ(error_of("BO_ 1 A 8 X"), "a.dbc:1: has \"8\" where \":\" should be" + form);
    EXPECT_EQ(error_of("BO_ 1 A: eight X"),
              "a.dbc:1: has \"eight\" where the number of bytes should be" + form);
    EXPECT_EQ(error_of("BO_ 1 A:\n\n" + good_signal),
              "a.dbc:1: ends where the number of bytes should be" + form);
    EXPECT_EQ(error_of("BO_\n\n" + message_with("")),
              "a.dbc:1: ends where an identifier should be" + form);
    EXPECT_EQ(error_of("BO_"), "a.dbc:1: ends where an identifier should be" + form);
}

TEST(DbcErrors, MessageNumbers) {
    EXPECT_EQ(error_of("BO_ 1 A: -1 X"), "a.dbc:1: message \"A\" has -1 bytes; expected 0 or more");
    const std::string expected =
        " is none; expected one of 11 bits (0…2047), or of 29 bits with bit 31 set";
    EXPECT_EQ(error_of("BO_ 2048 A: 8 X"), "a.dbc:1: identifier 2048" + expected);
    EXPECT_EQ(error_of("BO_ 2684354560 A: 8 X"), "a.dbc:1: identifier 2684354560" + expected);
    EXPECT_EQ(parse("BO_ 2684354559 A: 8 X").messages.at("A").frame, (FrameId{0x1fffffff, true}));
    EXPECT_EQ(parse("BO_ 2047 A: 8 X").messages.at("A").frame, (FrameId{0x7ff, false}));
}

TEST(DbcErrors, Duplicates) {
    EXPECT_EQ(error_of("BO_ 1 A: 8 X\n\nBO_ 2 A: 8 X"),
              "a.dbc:3: message \"A\" is there already, in line 1; expected another name");
    EXPECT_EQ(error_of("BO_ 1 A: 8 X\nBO_ 1 B: 8 X"),
              "a.dbc:2: message \"B\" has the identifier of \"A\" in line 1; expected one of its "
              "own");
    EXPECT_EQ(error_of(message_with(good_signal + good_signal)),
              "a.dbc:3: signal \"S\" is there already, in line 2; expected another name");
    // 11 and 29 bits are different identifiers
    EXPECT_EQ(parse("BO_ 1 A: 8 X\nBO_ 2147483649 B: 8 X").messages.size(), 2u);
}

TEST(DbcErrors, SignalForm) {
    const std::string form =
        "; a signal reads SG_ NAME : START|BITS@ORDER+ (SCALE,OFFSET) [MIN|MAX] "
        "\"UNIT\" RECEIVERS";
    const auto with = [&](const std::string& part, const std::string& by) {
        return error_of(message_with(replaced(good_signal, part, by)));
    };
    const auto told = [&](const std::string& found, const std::string& wanted) {
        return "a.dbc:2: " + found + " where " + wanted + " should be" + form;
    };
    EXPECT_EQ(with("S :", ":"), told("has \":\"", "the signal's name"));
    EXPECT_EQ(with("S :", "S x :"),
              told("has \"x\"", "\":\" or a multiplexer's mark (M, m0, m0M)"));
    EXPECT_EQ(with("S :", "S mM :"),
              told("has \"mM\"", "\":\" or a multiplexer's mark (M, m0, m0M)"));
    EXPECT_EQ(with("0|8", "|8"), told("has \"|\"", "the start bit"));
    EXPECT_EQ(with("0|8", "0.5|8"), told("has \"0.5\"", "the start bit"));
    EXPECT_EQ(with("0|8", "0 8"), told("has \"8\"", "\"|\""));
    EXPECT_EQ(with("|8@", "|@"), told("has \"@\"", "the number of bits"));
    EXPECT_EQ(with("@1+", ""), told("has \"(\"", "\"@\""));
    EXPECT_EQ(with("@1+", "@2+"), told("has \"2+\"", "the byte order, 0 or 1 and + or -,"));
    EXPECT_EQ(with("@1+", "@1"), told("has \"(\"", "+ or -"));
    EXPECT_EQ(with("(1,0)", "(one,0)"), told("has \"one\"", "the scale"));
    EXPECT_EQ(with("(1,0)", "(1)"), told("has \")\"", "\",\""));
    EXPECT_EQ(with("(1,0)", "(1,nan)"), told("has \"nan\"", "the offset"));
    EXPECT_EQ(with("[0|0]", "[0]"), told("has \"]\"", "\"|\""));
    EXPECT_EQ(with("[0|0]", "[a|0]"), told("has \"a\"", "the minimum"));
    EXPECT_EQ(with("[0|0]", "[0|]"), told("has \"]\"", "the maximum"));
    EXPECT_EQ(with("\"\" X", "X"), told("has \"X\"", "the unit in quotes"));
    EXPECT_EQ(with(" (1,0) [0|0] \"\" X\n", "\nBO_ 2 B: 8 X"), told("ends", "\"(\""));
    EXPECT_EQ(with(" (1,0) [0|0] \"\" X\n", ""), told("ends", "\"(\""));
}

TEST(DbcErrors, SignalsWithoutMessage) {
    const std::string told = ": a signal that belongs to no message; expected a BO_ line before it";
    EXPECT_EQ(error_of(good_signal), "a.dbc:1" + told);
    EXPECT_EQ(error_of("BO_ 1 A: 8 X\nCM_ \"\";\n" + good_signal), "a.dbc:3" + told);
}

// Published files have them: refused where they are asked for, and the others are there.
TEST(DbcErrors, SignalsThatLeaveTheirMessage) {
    const auto with = [&](const std::string& bits) {
        const std::string text =
            message_with(good_signal + " SG_ T : " + bits + " (1,0) [0|0] \"\" X");
        EXPECT_EQ(search_error("A.S", text), "no error");
        return search_error("A.T", text);
    };
    EXPECT_EQ(with("56|9@1+"), "a.dbc:3: signal \"T\": bits 56…64 leave a frame of 8 bytes");
    EXPECT_EQ(with("56|2@0+"), "a.dbc:3: signal \"T\": 2 bits from bit 56 on, big endian, leave a "
                               "frame of 8 bytes");
    EXPECT_EQ(with("0|0@1+"), "a.dbc:3: signal \"T\": 0 bits; expected 1…64");
    EXPECT_EQ(with("0|65@1+"), "a.dbc:3: signal \"T\": 65 bits; expected 1…64");
    EXPECT_EQ(with("600|8@1+"), "a.dbc:3: signal \"T\": start bit 600; expected 0…511");
    EXPECT_EQ(with("56|8@1+"), "no error");
    EXPECT_EQ(with("63|8@0+"), "no error");
}

TEST(DbcErrors, MessagesOfSeveralFrames) {
    const std::string text = "BO_ 1 A: 65 X\n" + good_signal + "BO_ 2 B: 8 X\n" + good_signal;
    EXPECT_EQ(search_error("B.S", text), "no error");
    EXPECT_EQ(search_error("A.S", text), "a.dbc:2: signal \"S\": its message of 65 bytes comes in "
                                         "several frames; that is not supported");
}

TEST(DbcErrors, ValueTypes) {
    const auto text = [&](const std::string& statement) {
        return message_with(good_signal + "\nSIG_VALTYPE_ " + statement);
    };
    const auto with = [&](const std::string& statement) { return error_of(text(statement)); };
    EXPECT_EQ(search_error("A.S", text("385 S : 1;")),
              "a.dbc:4: signal \"S\": a 32-bit float has 8 bits; expected 32");
    EXPECT_EQ(search_error("A.S", text("385 S : 2;")),
              "a.dbc:4: signal \"S\": a 64-bit float has 8 bits; expected 64");
    EXPECT_EQ(with("385 S : 3;"), "a.dbc:4: type 3; expected 0 (integer), 1 (float), 2 (double)");
    EXPECT_EQ(with("385 T : 1;"),
              "a.dbc:4: message \"A\" has no signal \"T\"; expected one of its SG_ lines");
    EXPECT_EQ(with("5 S : 1;"),
              "a.dbc:4: SIG_VALTYPE_ of a message that is not there; expected one "
              "of the BO_ lines above");
    EXPECT_EQ(with("385 S ;"), "a.dbc:4: has \";\" where the type (0, 1, 2) should be; a float "
                               "reads SIG_VALTYPE_ ID SIGNAL : 1;");
    EXPECT_EQ(with("385 S : 0;"), "no error");
}

TEST(DbcErrors, Search) {
    EXPECT_EQ(search_error("Position"),
              "a.dbc: \"Position\" is no signal's full name; expected MESSAGE.SIGNAL");
    EXPECT_EQ(search_error("DriveStaus.Position"),
              "a.dbc: has no message \"DriveStaus\"; did you mean \"DriveStatus\"?");
    EXPECT_EQ(search_error("Else.Position"),
              "a.dbc: has no message \"Else\"; expected one of DriveStatus, Extended, Muxed");
    EXPECT_EQ(
        search_error("DriveStatus.Torqe"),
        "a.dbc:38: message \"DriveStatus\" has no signal \"Torqe\"; did you mean \"Torque\"?");
    EXPECT_EQ(search_error("DriveStatus."),
              "a.dbc:38: message \"DriveStatus\" has no signal \"\"; expected one of Position, "
              "Torque, State");
}

TEST(DbcErrors, SearchAmongMany) {
    std::string text;
    for (int i = 0; i < 100; ++i)
        text += "BO_ " + std::to_string(i) + " Message" + std::to_string(i) + ": 8 X\n";
    const Dbc dbc = parse(text);
    try {
        find_signal(dbc, "Quite_another.S");
        FAIL();
    } catch (const FileError& error) {
        EXPECT_STREQ(error.what(), "a.dbc: has no message \"Quite_another\"; none of its 100 has a "
                                   "name like it");
    }
    try {
        find_signal(dbc, "Message7.S");
        FAIL();
    } catch (const FileError& error) {
        EXPECT_STREQ(error.what(),
                     "a.dbc:8: message \"Message7\" has no signal \"S\"; it has none");
    }
}

// Cut anywhere and with wrong bytes anywhere, a file is read or refused.
TEST(DbcErrors, BrokenFilesAreReadOrRefused) {
    constexpr unsigned seed = 417;
    std::mt19937 engine(seed);
    const auto below = [&](size_t limit) {
        return std::uniform_int_distribution<size_t>(0, limit - 1)(engine);
    };
    const std::string signs = "\"|@;:,()[]+-0 \n\\M\xff";
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = whole_file;
        for (size_t changes = below(4) + 1; changes > 0; --changes)
            text[below(text.size())] = signs[below(signs.size())];
        if (i % 2 == 0) text.resize(below(text.size()));
        const std::string error = error_of(text);
        refused += error != "no error";
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
    std::printf("figure: of 4000 broken DBC files %d refused, the others read (seed %u)\n", refused,
                seed);
    EXPECT_GT(refused, 1000);
}

} // namespace
