// CSV captures: every unit, the loose ends a text file may have, and exact round trips.
#include "capture/capture.hpp"
#include "capture/columns.hpp"
#include "capture_helpers.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace servoid;

namespace {

constexpr double pi = std::numbers::pi;

// One column besides the time, with 20 rows of 1.5 and 3 in turn, read into the named field.
std::vector<double> read_column(const std::string& name, std::vector<double> Capture::*field,
                                const CaptureScales& scales = {},
                                const std::string& metadata = "") {
    const ColumnMeaning* meaning = find_column(name);
    EXPECT_NE(meaning, nullptr) << name;
    const bool torque = meaning->signal == Signal::torque || meaning->signal == Signal::torque_ref;
    const bool motion = meaning->signal == Signal::position || meaning->signal == Signal::velocity;
    const bool linear = meaning->family == Family::linear;
    std::string head = "time_s," + name, tail;
    if (!torque) head += linear ? ",force_N" : ",torque_Nm", tail += ",1";
    if (!motion) head += linear ? ",velocity_m_s" : ",velocity_rad_s", tail += ",0";
    std::string text = metadata + head + "\n";
    for (int i = 0; i < 20; ++i)
        text += format_number(i * 0.001) + (i % 2 ? ",3" : ",1.5") + tail + "\n";
    return read_text(text, scales).*field;
}

struct UnitCase {
    const char* name;
    std::vector<double> Capture::*field;
    double si_of_3;
};

TEST(CaptureCsv, EveryUnitIsReadInSi) {
    const CaptureScales scales = {
        .rated_torque = 0.637, .torque_constant = 0.25, .position_per_count = 1e-3};
    const UnitCase cases[] = {
        {"torque_ref_Nm", &Capture::torque_ref, 3},
        {"torque_ref_mNm", &Capture::torque_ref, 0.003},
        {"torque_ref_permille", &Capture::torque_ref, 3 * 0.637 / 1000},
        {"force_ref_N", &Capture::torque_ref, 3},
        {"current_ref_A", &Capture::torque_ref, 0.75},
        {"torque_Nm", &Capture::torque, 3},
        {"torque_mNm", &Capture::torque, 0.003},
        {"torque_permille", &Capture::torque, 3 * 0.637 / 1000},
        {"force_N", &Capture::torque, 3},
        {"current_A", &Capture::torque, 0.75},
        {"position_rad", &Capture::position, 3},
        {"position_rev", &Capture::position, 6 * pi},
        {"position_deg", &Capture::position, 3 * pi / 180},
        {"position_count", &Capture::position, 0.003},
        {"position_m", &Capture::position, 3},
        {"position_mm", &Capture::position, 0.003},
        {"position_ref_rad", &Capture::position_ref, 3},
        {"position_ref_deg", &Capture::position_ref, 3 * pi / 180},
        {"position_ref_mm", &Capture::position_ref, 0.003},
        {"load_position_rev", &Capture::load_position, 6 * pi},
        {"load_position_m", &Capture::load_position, 3},
        {"velocity_rad_s", &Capture::velocity, 3},
        {"velocity_rpm", &Capture::velocity, 3 * 2 * pi / 60},
        {"velocity_rev_s", &Capture::velocity, 6 * pi},
        {"velocity_deg_s", &Capture::velocity, 3 * pi / 180},
        {"velocity_m_s", &Capture::velocity, 3},
        {"velocity_mm_s", &Capture::velocity, 0.003},
        {"velocity_ref_rpm", &Capture::velocity_ref, 3 * 2 * pi / 60},
        {"velocity_ref_mm_s", &Capture::velocity_ref, 0.003},
    };
    for (const UnitCase& unit : cases) {
        SCOPED_TRACE(unit.name);
        const auto values = read_column(unit.name, unit.field, scales);
        ASSERT_EQ(values.size(), 20u);
        EXPECT_NEAR(values[1], unit.si_of_3, 1e-15 * unit.si_of_3);
        EXPECT_NEAR(values[0], unit.si_of_3 / 2, 1e-15 * unit.si_of_3);
    }
}

TEST(CaptureCsv, TimeUnits) {
    for (const auto& [head, step] :
         {std::pair{"time_s", 0.125}, {"time_ms", 125.0}, {"time_us", 125000.0}}) {
        std::string text = std::string(head) + ",torque_Nm,velocity_rad_s\n";
        for (int i = 0; i < 20; ++i)
            text += format_number(i * step) + ",1," + std::to_string(i) + "\n";
        const Capture capture = read_text(text);
        EXPECT_EQ(capture.sample_time_s, 0.125) << head;
        EXPECT_EQ(capture.time_s[19], 19 * 0.125) << head;
    }
}

TEST(CaptureCsv, ScalesComeFromTheMetadataWhereTheModelHasNone) {
    const std::string rated = "# rated_torque_Nm = 2\n",
                      constant = "#torque_constant_Nm_per_A=0.5\n";
    EXPECT_NEAR(read_column("torque_permille", &Capture::torque, {}, rated)[1], 0.006, 1e-17);
    EXPECT_NEAR(read_column("torque_permille", &Capture::torque, {.rated_torque = 4}, rated)[1],
                0.012, 1e-17);
    EXPECT_EQ(read_column("current_A", &Capture::torque, {}, constant)[1], 1.5);
    EXPECT_EQ(read_column("current_A", &Capture::torque)[1], 3);
    EXPECT_NEAR(
        read_column("position_count", &Capture::position, {}, "# counts_per_rev = 4096\n")[1],
        3 * 2 * pi / 4096, 1e-17);
}

TEST(CaptureCsv, AmpereWithoutAConstantIsSaid) {
    const std::string text = sine_csv("time_s,current_A,position_rad");
    EXPECT_TRUE(read_text(text).torque_in_ampere);
    EXPECT_FALSE(read_text(text, {.torque_constant = 1}).torque_in_ampere);
    EXPECT_FALSE(read_text("# torque_constant_Nm_per_A = 0.1\n" + text).torque_in_ampere);
}

TEST(CaptureCsv, TheAxisFollowsTheColumnsThenTheModel) {
    EXPECT_FALSE(read_text(sine_csv("time_s,torque_Nm,position_rad")).linear);
    EXPECT_TRUE(read_text(sine_csv("time_s,force_N,position_m")).linear);
    EXPECT_TRUE(read_text(sine_csv("time_s,current_A,position_mm")).linear);
    EXPECT_TRUE(
        read_text(sine_csv("time_s,torque_permille,position_m"), {.rated_torque = 9}).linear);
    const std::string open = sine_csv("time_s,current_A,position_count");
    EXPECT_FALSE(read_text("# counts_per_rev = 100\n" + open).linear);
    EXPECT_TRUE(read_text("# metres_per_count = 1e-6\n" + open).linear);
    EXPECT_TRUE(read_text(open, {.position_per_count = 1e-6, .linear = true}).linear);
}

TEST(CaptureCsv, MetadataIsKeptAndUnderstood) {
    const Capture capture =
        read_text("# source = a bench, with = signs\n#period_s=6.24\n# a remark\n"
                  "# torque_hold = none\n# torque_delay_s = 2.5e-4\n" +
                  sine_csv("time_s,torque_ref_Nm,position_rad"));
    EXPECT_EQ(capture.metadata.at("source"), "a bench, with = signs");
    EXPECT_EQ(capture.metadata.size(), 4u);
    EXPECT_EQ(capture.period_s, 6.24);
    EXPECT_FALSE(capture.ref_held);
    EXPECT_EQ(capture.torque_delay_s, 2.5e-4);
    EXPECT_TRUE(read_text(sine_csv("time_s,torque_ref_Nm,position_rad")).ref_held);
}

// What editors and loggers do to a text file without changing what it says.
TEST(CaptureCsv, LooseEndsOfATextFile) {
    const std::string plain = sine_csv("time_s,torque_Nm,position_rad");
    const std::string expected = format_capture_csv(read_text(plain));
    std::string windows = "\xef\xbb\xbf", spaced, commented;
    for (const char c : plain) {
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
        spaced += c == ',' ? std::string(" ,\t") : std::string(1, c);
        commented += c == '\n' ? std::string("\n# a comment = here, too\n") : std::string(1, c);
    }
    EXPECT_EQ(format_capture_csv(read_text(windows)), expected);
    EXPECT_EQ(format_capture_csv(read_text(spaced)), expected);
    EXPECT_EQ(format_capture_csv(read_text(commented)), expected);
    EXPECT_EQ(format_capture_csv(read_text("\n\n" + plain + "\n\r\n  \n")), expected);
    EXPECT_EQ(format_capture_csv(read_text(plain.substr(0, plain.size() - 1))), expected);
}

TEST(CaptureCsv, LinesAreCountedThroughComments) {
    std::string text = "# one\n\ntime_s,torque_Nm,position_rad\n";
    for (int i = 0; i < 30; ++i) {
        if (i % 7 == 3) text += "# pause\n";
        text += format_number(i * 0.001) + (i == 20 ? ",x,1\n" : ",1,1\n");
    }
    EXPECT_NE(error_of_text(text).find(":27: "), std::string::npos) << error_of_text(text);
}

TEST(CaptureCsv, AMegabyteInOneLineIsRefusedQuickly) {
    const std::string error =
        error_of_text("time_s,torque_Nm,position_rad\n" + std::string(1 << 20, ','));
    EXPECT_NE(error.find(":2: line of 1048576 bytes"), std::string::npos) << error;
}

double random_double(std::mt19937_64& random) {
    const double mantissa = std::ldexp(static_cast<double>(random() >> 11), -53) - 0.5;
    return mantissa * std::pow(10.0, static_cast<double>(random() % 9) - 4.0);
}

Capture random_capture(std::mt19937_64& random) {
    Capture capture;
    capture.linear = random() % 2;
    capture.torque_in_ampere = random() % 3 == 0;
    capture.ref_held = random() % 2;
    if (random() % 2) capture.torque_delay_s = std::abs(random_double(random));
    if (random() % 2) capture.period_s = std::abs(random_double(random)) + 1e-9;
    const size_t rows = 16 + random() % 100;
    const double step = std::abs(random_double(random)) + 1e-6;
    capture.sample_time_s = step;
    const auto fill = [&](std::vector<double>& column) {
        for (size_t i = 0; i < rows; ++i)
            column.push_back(random_double(random));
    };
    for (size_t i = 0; i < rows; ++i)
        capture.time_s.push_back(static_cast<double>(i) * step);
    const bool position = random() % 2; // both would have to fit each other
    fill(position ? capture.position : capture.velocity);
    fill(random() % 2 ? capture.torque : capture.torque_ref);
    if (random() % 2) fill(capture.position_ref);
    if (random() % 2) fill(capture.velocity_ref);
    if (random() % 2) fill(capture.load_position);
    if (random() % 2)
        for (size_t i = 0; i < rows; ++i)
            capture.segment.push_back(static_cast<int>(random() % 9) - 4);
    capture.metadata["source"] = "seed, = and all";
    return capture;
}

void expect_same(const Capture& a, const Capture& b) {
    EXPECT_EQ(a.time_s, b.time_s);
    EXPECT_EQ(a.torque_ref, b.torque_ref);
    EXPECT_EQ(a.torque, b.torque);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.position_ref, b.position_ref);
    EXPECT_EQ(a.velocity_ref, b.velocity_ref);
    EXPECT_EQ(a.load_position, b.load_position);
    EXPECT_EQ(a.segment, b.segment);
    EXPECT_EQ(a.torque_in_ampere, b.torque_in_ampere);
    EXPECT_EQ(a.linear, b.linear);
    EXPECT_EQ(a.sample_time_s, b.sample_time_s);
    EXPECT_EQ(a.uniform, b.uniform);
    EXPECT_EQ(a.ref_held, b.ref_held);
    EXPECT_EQ(a.torque_delay_s, b.torque_delay_s);
    EXPECT_EQ(a.period_s, b.period_s);
}

TEST(CaptureCsv, RandomCapturesReadBackBitByBit) {
    for (unsigned seed = 1; seed <= 500 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        const Capture capture = random_capture(random);
        const std::string text = format_capture_csv(capture);
        const Capture again = read_text(text);
        expect_same(again, capture);
        EXPECT_EQ(again.metadata.at("source"), capture.metadata.at("source"));
        EXPECT_EQ(format_capture_csv(read_text(format_capture_csv(again))),
                  format_capture_csv(again));
    }
}

TEST(CaptureCsv, RandomDamageIsReadOrRefusedButNeverCrashes) {
    const std::string plain =
        "# sample_time_s = 0.001\n" + sine_csv("time_s,torque_Nm,position_rad");
    for (unsigned seed = 1; seed <= 3000; ++seed) {
        std::mt19937_64 random(seed);
        std::string text = plain;
        for (int i = 0; i < 3; ++i)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        if (random() % 4 == 0) text.resize(random() % text.size());
        EXPECT_NO_THROW(error_of_text(text)) << "seed " << seed;
    }
}

} // namespace
