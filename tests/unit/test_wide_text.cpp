#include "report/bar.hpp"
#include "report/sparkline.hpp"
#include "report/wide_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace servoid;

namespace {

using Lines = std::vector<std::string>;

TEST(WideText, WidthIsColumnsNotBytes) {
    EXPECT_EQ(display_width("1.2 ± 0.3 N·m"), 13);
    EXPECT_EQ(display_width("a\u0308"), 1); // a combining mark
    EXPECT_EQ(display_width("轴"), 2);
    EXPECT_EQ(display_width("\033[1;33mmissing\033[0m"), 7);
    EXPECT_EQ(display_width("\xff\xe2\x82"), 3) << "bytes of no character";
}

TEST(WideText, ShortenedEndsWithADotsCharacter) {
    EXPECT_EQ(shortened("coulomb", 7), "coulomb");
    EXPECT_EQ(shortened("coulomb", 6), "coulo…");
    EXPECT_EQ(shortened("N·m·s/rad", 4), "N·m…");
    EXPECT_EQ(shortened("one, two", 6), "one…");
    EXPECT_EQ(shortened("ab", 1), "…");
    EXPECT_EQ(shortened("ab", 0), "");
}

TEST(WideText, WrappedAtBlanksWithAnIndent) {
    EXPECT_EQ(wrapped("record a longer travel", 12, 2),
              (Lines{"record a", "  longer", "  travel"}));
    EXPECT_EQ(wrapped("  a  b", 10, 4), (Lines{"  a  b"}));
    EXPECT_EQ(wrapped("exactly ten", 11, 0), (Lines{"exactly ten"}));
    EXPECT_EQ(wrapped("", 10, 2), (Lines{""}));
    EXPECT_EQ(wrapped("blanks at the end   ", 17, 2), (Lines{"blanks at the end"}));
}

TEST(WideText, AWordThatIsTooLongIsBrokenBehindAComma) {
    EXPECT_EQ(wrapped("stroke=6,velocity=50", 14, 0), (Lines{"stroke=6,", "velocity=50"}));
    EXPECT_EQ(wrapped("abcdefgh", 3, 0), (Lines{"abc", "def", "gh"}));
    EXPECT_EQ(wrapped("····", 3, 0), (Lines{"···", "·"}));
}

TEST(WideText, ACommandStaysOne) {
    EXPECT_EQ(wrapped_command({"servoid", "add", "coulomb"}, 80), (Lines{"servoid add coulomb"}));
    EXPECT_EQ(wrapped_command({"servoid", "add", "coulomb"}, 15),
              (Lines{"servoid add \\", "    coulomb"}));
    EXPECT_EQ(wrapped_command({"abcdef", "g"}, 6), (Lines{"abcd\\", "ef g"}));
    EXPECT_EQ(wrapped_command({"'a b c d e f'", "g"}, 8), (Lines{"'a b c d e f' \\", "    g"}))
        << "quotes hold a backslash as it is";
}

TEST(WideText, InAscii) {
    EXPECT_EQ(in_ascii("1 ± 2 kg·m², 0…3 → θ"), "1 +- 2 kg*m^2, 0...3 -> theta");
    EXPECT_EQ(in_ascii("a\u0308轴"), "a?");
}

TEST(Bar, EighthsAndHashes) {
    EXPECT_EQ(bar(0.5, {4, true}), "██");
    EXPECT_EQ(bar(0.53125, {4, true}), "██▏");
    EXPECT_EQ(bar(1e-6, {4, true}), "▏");
    EXPECT_EQ(bar(0, {4, true}), "");
    EXPECT_EQ(bar(2, {4, true}), "████");
    EXPECT_EQ(bar(0.6, {4, false}), "##");
    EXPECT_EQ(bar(0.01, {4, false}), "");
}

TEST(Bar, TheMarkIsSeenInsideAndBehind) {
    EXPECT_EQ(marked_bar(1, 0.5, {4, true}).text(), "██│█");
    EXPECT_EQ(marked_bar(0.25, 0.5, {4, true}).text(), "█ │ ");
    EXPECT_EQ(marked_bar(0.25, 1, {4, false}).text(), "#  |");
    EXPECT_EQ(marked_bar(0, 0, {3, true}).text(), "│  ");
}

TEST(Skyline, FromZeroToFullScale) {
    EXPECT_EQ(skyline({0, 0.5, 1, 7}, 1, true), "▁▅██");
    EXPECT_EQ(skyline({0, 0.5, 1, NAN}, 1, false), ".+@ ");
    EXPECT_EQ(skyline({1}, 0, true), "▁");
}

} // namespace
