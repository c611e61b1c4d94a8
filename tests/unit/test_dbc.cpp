// DBC files: what is read.
#include "common/file.hpp"
#include "unit/dbc_helpers.hpp"

#include <cmath>
#include <cstdio>

using namespace servoid;
using namespace servoid::can;

namespace {

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

} // namespace
