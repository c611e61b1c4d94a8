#include "can/dbc.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

using namespace servoid;
using namespace servoid::can;

namespace {

// Every section that a DBC has, and strings that look like sections.
const std::string whole_file = R"(VERSION "1.0 // no comment; BO_ 1 No: 8 X"

NS_ :
	NS_DESC_
	CM_
	BA_DEF_
	BA_
	VAL_
	CAT_DEF_
	CAT_
	FILTER
	BA_DEF_DEF_
	EV_DATA_
	ENVVAR_DATA_
	SGTYPE_
	SGTYPE_VAL_
	BA_DEF_SGTYPE_
	BA_SGTYPE_
	SIG_TYPE_REF_
	VAL_TABLE_
	SIG_GROUP_
	SIG_VALTYPE_
	SIGTYPE_VALTYPE_
	BO_TX_BU_
	BA_DEF_REL_
	BA_REL_
	BA_DEF_DEF_REL_
	BU_SG_REL_
	BU_EV_REL_
	BU_BO_REL_
	SG_MUL_VAL_

BS_: 500 : 1,2

BU_: Drive Master
VAL_TABLE_ States 1 "BO_ 7 On: 8 X" 0 "Off" ;

BO_ 385 DriveStatus: 8 Drive
 SG_ Position : 0|32@1- (0.0001,-5) [-1E+30|1.5e3] "rad"  Master,Other
 SG_ Torque : 39|16@0- (0.01,0) [0|0] "Nm" Master
 SG_ State : 48|4@1+ (1,0) [0|15] "" Vector__XXX

BO_ 2566834709 Extended: 64 Vector__XXX
 SG_ Single : 0|32@1- (1,0) [0|0] "" Vector__XXX
 SG_ Double : 39|64@0- (1,0) [0|0] "" Vector__XXX

BO_ 512 Muxed: 8 Drive
 SG_ Selector M : 0|8@1+ (1,0) [0|0] "" Master
 SG_ First m0 : 8|8@1+ (1,0) [0|0] "" Master
 SG_ Inner m12M : 8|8@1+ (1,0) [0|0] "" Master

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Orphan : 0|8@1+ (1,0) [0|0] "" Vector__XXX

BO_TX_BU_ 385 : Drive,Master;
EV_ Environment: 0 [0|1] "BO_" 0 2 DUMMY_NODE_VECTOR0 Drive;
ENVVAR_DATA_ Environment: 5;
CM_ "SG_ about nothing";
CM_ BO_ 385 "several lines:
BO_ 385 Twice: 8 X
 SG_ Position : 900|32@1- (1,0) [0|0] \"\" X
SIG_VALTYPE_ 385 Position : 2;
";
CM_ SG_ 385 Position "a quote: \"; BO_ 5 A: 8 X\" // still inside";
CM_ BU_ Drive "";
BA_DEF_ BO_  "GenMsgCycleTime" INT 0 65535;
BA_DEF_ "BusType" STRING ;
BA_DEF_DEF_  "GenMsgCycleTime" 0;
BA_ "BusType" "CAN FD";
BA_ "GenMsgCycleTime" BO_ 385 1;
BA_ "GenSigStartValue" SG_ 385 State 3;
BA_REL_ "Rel" BU_SG_REL_ Drive SG_ 385 State 1;
VAL_ 385 State 1 "On" 0 "SG_ Off : ;" ;
SIG_GROUP_ 385 Group 1 : Position Torque;
SIG_VALTYPE_ 2566834709 Single : 1;
SIG_VALTYPE_ 2566834709 Double : 2;
SIG_VALTYPE_ 385 State : 0;
SIG_VALTYPE_ 3221225472 Orphan : 1;
SG_MUL_VAL_ 512 First Selector 0-0, 3-5;
)";

Dbc parse(const std::string& text) { return parse_dbc(text, "a.dbc"); }

std::string error_of(const std::string& text) {
    try {
        parse(text);
        return "no error";
    } catch (const FileError& error) {
        return error.what();
    }
}

std::string search_error(const std::string& name) {
    try {
        find_signal(parse(whole_file), name);
        return "no error";
    } catch (const FileError& error) {
        return error.what();
    }
}

// A file with one message of 8 bytes; `signals` are lines 2 and following.
std::string message_with(const std::string& signals) { return "BO_ 385 A: 8 X\n" + signals; }

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), by);
}

const std::string good_signal = " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n";

// --- what is read ------------------------------------------------------------------------------

TEST(Dbc, MessagesOfTheWholeFile) {
    const Dbc dbc = parse(whole_file);
    EXPECT_EQ(dbc.path, "a.dbc");
    ASSERT_EQ(dbc.messages.size(), 3u);
    const DbcMessage& status = dbc.messages.at("DriveStatus");
    EXPECT_EQ(status.frame, (FrameId{385, false}));
    EXPECT_EQ(status.bytes, 8);
    EXPECT_EQ(status.line, 38);
    EXPECT_EQ(status.signals.size(), 3u);
    const DbcMessage& extended = dbc.messages.at("Extended");
    EXPECT_EQ(extended.frame, (FrameId{2566834709u & 0x1fffffffu, true}));
    EXPECT_EQ(extended.bytes, 64);
}

TEST(Dbc, SignalsOfTheWholeFile) {
    const Dbc dbc = parse(whole_file);
    const DbcSignal& position = find_signal(dbc, "DriveStatus.Position");
    EXPECT_EQ(position.field.name, "Position");
    EXPECT_EQ(position.field.frame, (FrameId{385, false}));
    EXPECT_EQ(position.field.start_bit, 0);
    EXPECT_EQ(position.field.length, 32);
    EXPECT_EQ(position.field.order, ByteOrder::little);
    EXPECT_EQ(position.field.kind, FieldKind::signed_integer);
    EXPECT_EQ(position.field.scale, 0.0001);
    EXPECT_EQ(position.field.offset, -5);
    EXPECT_EQ(position.minimum, -1e30);
    EXPECT_EQ(position.maximum, 1500);
    EXPECT_EQ(position.unit, "rad");
    EXPECT_EQ(position.line, 39);
    EXPECT_EQ(find_signal(dbc, "DriveStatus.Torque").field.order, ByteOrder::big);
    EXPECT_EQ(find_signal(dbc, "DriveStatus.State").field.kind, FieldKind::unsigned_integer);
}

TEST(Dbc, FloatsAreThoseOfSigValtype) {
    const Dbc dbc = parse(whole_file);
    EXPECT_EQ(find_signal(dbc, "Extended.Single").field.kind, FieldKind::float32);
    EXPECT_EQ(find_signal(dbc, "Extended.Double").field.kind, FieldKind::float64);
    // without the colon, as old files have it
    const std::string old = replaced(whole_file, "Single : 1", "Single 1");
    EXPECT_EQ(find_signal(parse(old), "Extended.Single").field.kind, FieldKind::float32);
}

TEST(Dbc, Multiplexing) {
    const Dbc dbc = parse(whole_file);
    const auto& signals = dbc.messages.at("Muxed").signals;
    ASSERT_EQ(signals.size(), 3u);
    EXPECT_TRUE(signals[0].multiplexor && !signals[0].multiplexed);
    EXPECT_TRUE(!signals[1].multiplexor && signals[1].multiplexed);
    EXPECT_TRUE(signals[2].multiplexor && signals[2].multiplexed);
    EXPECT_EQ(find_signal(dbc, "Muxed.Selector").field.name, "Selector"); // is always there
    EXPECT_EQ(search_error("Muxed.First"), "a.dbc:49: signal \"Muxed.First\" is multiplexed; "
                                           "multiplexed signals are not supported");
    EXPECT_EQ(search_error("Muxed.Inner"), "a.dbc:50: signal \"Muxed.Inner\" is multiplexed; "
                                           "multiplexed signals are not supported");
}

TEST(Dbc, LineEndsAndByteOrderMark) {
    std::string windows = "\xef\xbb\xbf";
    for (const char c : whole_file)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const Dbc dbc = parse(windows);
    EXPECT_EQ(dbc.messages.size(), 3u);
    EXPECT_EQ(dbc.messages.at("DriveStatus").line, 38);
    EXPECT_EQ(parse("\xef\xbb\xbf"
                    "BO_ 1 A: 8 X")
                  .messages.size(),
              1u);
}

TEST(Dbc, SmallestFile) {
    EXPECT_EQ(parse("BO_ 1 A: 8 X").messages.at("A").signals.size(), 0u);
    EXPECT_EQ(parse(message_with(good_signal)).messages.at("A").signals.size(), 1u);
    // no blanks, more blanks, no receiver
    EXPECT_EQ(parse("BO_ 1 A:8 X\nSG_ S:0|8@1+(1,0)[0|0]\"\"").messages.at("A").signals.size(), 1u);
    EXPECT_EQ(parse("\tBO_ 1 A : 8 X\n\n\t SG_ S : 7 | 8 @ 0 - ( 1 , 0 ) [ 0 | 0 ] \"\" X , Y")
                  .messages.at("A")
                  .signals.at(0)
                  .field.kind,
              FieldKind::signed_integer);
}

TEST(Dbc, SymbolsWithoutBusTimingOrOnOneLine) {
    const std::string end = "CM_ \"no more\";\n" + message_with(good_signal);
    EXPECT_EQ(parse("NS_ :\n\tCM_\n\tBA_\n\tSIG_VALTYPE_\n\tBO_TX_BU_\n" + end).messages.size(),
              1u);
    EXPECT_EQ(parse("NS_ : CM_ BA_ SIG_VALTYPE_ SG_MUL_VAL_\nBS_:\nBU_: A\n" + end).messages.size(),
              1u);
    EXPECT_EQ(
        parse("NS_ :\nBA_\nSIG_VALTYPE_\nBO_TX_BU_\nSG_MUL_VAL_\n\nBS_:\n" + end).messages.size(),
        1u);
    EXPECT_EQ(parse("NS_ :\nBA_DEF_ BO_ \"x\" INT 0 1;\n" + end).messages.size(), 1u);
    EXPECT_EQ(parse("NS_ :\nBS_:\nBU_:\n" + end).messages.size(), 1u);
}

TEST(Dbc, MissingSemicolonEndsAtTheNextSection) {
    EXPECT_EQ(parse("CM_ \"text\"\n" + message_with(good_signal)).messages.size(), 1u);
    EXPECT_EQ(parse("MADE_UP_ 1 2 3 ;\n" + message_with(good_signal)).messages.size(), 1u);
}

TEST(Dbc, KeywordsOfOldAsNames) {
    const Dbc dbc = parse("VERSION \"\"\nBU_: FILTER VERSION\nBO_ 1 FILTER: 8 FILTER\n" +
                          replaced(good_signal, "S :", "VERSION :"));
    EXPECT_EQ(find_signal(dbc, "FILTER.VERSION").line, 4);
}

TEST(Dbc, LimitsBeyondADouble) {
    const DbcSignal signal =
        parse(message_with(replaced(good_signal, "[0|0]", "[-4E+481|+4.4E481]")))
            .messages.at("A")
            .signals.at(0);
    EXPECT_EQ(signal.minimum, -HUGE_VAL);
    EXPECT_EQ(signal.maximum, HUGE_VAL);
}

TEST(Dbc, LinesWithinStringsCount) {
    const Dbc dbc = parse("VERSION \"a\nb\r\nc\"\n" + message_with(good_signal));
    EXPECT_EQ(find_signal(dbc, "A.S").line, 5);
}

TEST(Dbc, Comments) {
    const Dbc dbc = parse("// BO_ 1 B: 8 X\n" + message_with("// SG_ \"\n" + good_signal));
    EXPECT_EQ(dbc.messages.size(), 1u);
    EXPECT_EQ(find_signal(dbc, "A.S").line, 4);
}

TEST(Dbc, OtherCodePages) {
    const auto unit_of = [](const std::string& unit) {
        return find_signal(parse(message_with(replaced(good_signal, "\"\"", "\"" + unit + "\"")) +
                                 "CM_ \"\x80\xff\xfe\x81\";\n"),
                           "A.S")
            .unit;
    };
    EXPECT_EQ(unit_of("\xb0\x43"), "\xc2\xb0\x43");     // Latin-1 degC
    EXPECT_EQ(unit_of("\xc2\xb0\x43"), "\xc2\xb0\x43"); // UTF-8 already
    EXPECT_EQ(unit_of("\xe4/\x80"), "\xc3\xa4/?");      // CP1252's euro is no Latin-1
    EXPECT_EQ(unit_of("%"), "%");
}

TEST(Dbc, ReadsAFile) {
    const std::string path = testing::TempDir() + "servoid_read.dbc";
    write_file(path, whole_file);
    EXPECT_EQ(read_dbc(path).messages.size(), 3u);
    EXPECT_EQ(read_dbc(path).path, path);
    std::remove(path.c_str());
    try {
        read_dbc("no/such.dbc");
        FAIL();
    } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find("no/such.dbc"), std::string::npos);
    }
}

// --- what is refused ---------------------------------------------------------------------------

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
    EXPECT_EQ(error_of("BO_ 1 A: 65 X"), "a.dbc:1: message \"A\" has 65 bytes; expected 0…64");
    EXPECT_EQ(error_of("BO_ 1 A: -1 X"), "a.dbc:1: message \"A\" has -1 bytes; expected 0…64");
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

TEST(DbcErrors, SignalsThatLeaveTheirMessage) {
    const auto with = [&](const std::string& bits) {
        return error_of(message_with(good_signal + " SG_ T : " + bits + " (1,0) [0|0] \"\" X"));
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

TEST(DbcErrors, ValueTypes) {
    const auto with = [&](const std::string& statement) {
        return error_of(message_with(good_signal + "\nSIG_VALTYPE_ " + statement));
    };
    EXPECT_EQ(with("385 S : 1;"), "a.dbc:4: signal \"S\": a 32-bit float has 8 bits; expected 32");
    EXPECT_EQ(with("385 S : 2;"), "a.dbc:4: signal \"S\": a 64-bit float has 8 bits; expected 64");
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
