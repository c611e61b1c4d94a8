// What the page draws of a signal: nothing higher or lower than it may get lost.
#include "story/series.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace servoid {
namespace {

std::vector<double> decoded(const Json& series, const char* end) {
    static const std::string digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<uint8_t> bytes;
    uint32_t bits = 0;
    int count = 0;
    for (const char c : series[end].get<std::string>()) {
        if (c == '=') break;
        bits = bits << 6 | uint32_t(digits.find(c)), count += 6;
        if (count >= 8) count -= 8, bytes.push_back(uint8_t(bits >> count));
    }
    std::vector<double> out;
    for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const auto code = int16_t(uint16_t(bytes[i] | bytes[i + 1] << 8));
        out.push_back(code == INT16_MIN
                          ? NAN
                          : series["offset"].get<double>() + code * series["scale"].get<double>());
    }
    return out;
}

std::vector<double> wave(size_t count) {
    std::vector<double> out;
    for (size_t i = 0; i < count; ++i)
        out.push_back(3 + 2 * std::sin(0.01 * double(i)));
    return out;
}

TEST(Series, ShortOnesAreWhole) {
    for (const size_t count : {1U, 2U, 3U, 4U, 5U, 999U, 1000U}) {
        const std::vector<double> values = wave(count);
        const Json series = series_json(values, {0.5, 0.001}, 1000);
        EXPECT_EQ(series["bucket"], 1);
        EXPECT_TRUE(series["high"].is_null());
        EXPECT_EQ(series["step_s"], 0.001);
        const std::vector<double> low = decoded(series, "low");
        ASSERT_EQ(low.size(), count);
        for (size_t i = 0; i < count; ++i)
            EXPECT_NEAR(low[i], values[i], 4.0 / 65534);
    }
}

TEST(Series, APeakOfOneSampleIsInItsBucket) {
    std::vector<double> values = wave(1'000'003);
    values[777'777] = 50, values[333'333] = -40;
    const Json series = series_json(values, {0, 125e-6}, 5000);
    const auto bucket = series["bucket"].get<size_t>();
    EXPECT_EQ(bucket, 201U);
    EXPECT_NEAR(series["step_s"].get<double>(), 201 * 125e-6, 1e-15);
    const std::vector<double> low = decoded(series, "low"), high = decoded(series, "high");
    ASSERT_EQ(low.size(), series["count"].get<size_t>());
    ASSERT_EQ(high.size(), low.size());
    const double step = 90.0 / 65534;
    EXPECT_NEAR(high[777'777 / bucket], 50, step);
    EXPECT_NEAR(low[333'333 / bucket], -40, step);
    for (size_t i = 0; i < values.size(); ++i) {
        ASSERT_LE(low[i / bucket], values[i] + step) << i;
        ASSERT_GE(high[i / bucket], values[i] - step) << i;
    }
}

TEST(Series, WhatIsNoNumberIsAGap) {
    const Json series = series_json(std::vector<double>{1, NAN, 2}, {0, 1}, 10);
    const std::vector<double> low = decoded(series, "low");
    EXPECT_TRUE(std::isnan(low[1]));
    EXPECT_DOUBLE_EQ(low[0], 1);
    EXPECT_DOUBLE_EQ(low[2], 2);
    for (const double value : decoded(series_json(std::vector<double>{NAN, NAN}, {0, 1}, 1), "low"))
        EXPECT_TRUE(std::isnan(value));
}

TEST(Series, AConstantStaysWhatItIs) {
    for (const double value : {0.0, -7.25, 1e-300, 1e300})
        EXPECT_EQ(decoded(series_json(std::vector<double>{value, value}, {0, 1}, 10), "low")[0],
                  value);
    EXPECT_TRUE(series_json({}, {0, 1}, 10).is_null());
}

} // namespace
} // namespace servoid
