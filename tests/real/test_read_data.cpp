// Every measured file must read, with the facts its README states.
#include "capture/capture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <numbers>

using namespace servoid;
namespace fs = std::filesystem;

namespace {

std::string data_folder() {
    const char* stated = std::getenv("SERVOID_DATA_DIR");
    return stated ? stated : std::string(SERVOID_SOURCE_DIR) + "/../shared/data";
}

#define SKIP_WITHOUT(path)                                                                         \
    if (!fs::exists(path)) GTEST_SKIP() << "skipped: no data"

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() ? 0 : INFINITY;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

TEST(RealData, EmpsCsvAndMatAreTheSameRecord) {
    const std::string folder = data_folder() + "/emps/";
    SKIP_WITHOUT(folder + "DATA_EMPS.mat");
    const Capture csv = read_capture(folder + "emps_train.csv");
    const SignalMap map = read_signal_map(folder + "emps_map.toml");
    const Capture mat = read_capture(folder + "DATA_EMPS.mat", {}, &map);
    ASSERT_EQ(csv.rows(), 24841u);
    ASSERT_EQ(mat.rows(), 24841u);
    for (const Capture* capture : {&csv, &mat}) {
        EXPECT_TRUE(capture->linear);
        EXPECT_TRUE(capture->uniform);
        EXPECT_FALSE(capture->torque_in_ampere);
        EXPECT_NEAR(capture->sample_time_s, 1e-3, 1e-9);
        EXPECT_NEAR(capture->position_quantum, 5e-8, 1e-13);
    }
    EXPECT_LT(largest_difference(csv.time_s, mat.time_s), 5.1e-7);
    EXPECT_LT(largest_difference(csv.position, mat.position), 5.1e-9);
    EXPECT_LT(largest_difference(csv.position_ref, mat.position_ref), 5.1e-10);
    // The map's scale is rounded: 1.4 ppm above the CSV's, of up to 351 N.
    EXPECT_LT(largest_difference(csv.torque_ref, mat.torque_ref), 5.1e-6 + 351 * 1.4e-6);
}

TEST(RealData, MotorBench) {
    const std::string path = data_folder() + "/motor_bench/motor_bench.csv";
    SKIP_WITHOUT(path);
    const Capture capture = read_capture(path);
    ASSERT_EQ(capture.rows(), 50000u);
    EXPECT_TRUE(capture.torque_in_ampere);
    EXPECT_TRUE(capture.uniform);
    EXPECT_EQ(capture.sample_time_s, 4e-4);
    EXPECT_EQ(capture.period_s, 1.0);
    EXPECT_EQ(capture.torque_ref.size(), capture.rows());
    EXPECT_EQ(capture.torque.size(), capture.rows());
    EXPECT_EQ(capture.load_position.size(), capture.rows());
    EXPECT_EQ(capture.torque_ref.back(), 0.0);
    const double bits_20 = 2 * std::numbers::pi / (1 << 20);
    EXPECT_NEAR(capture.position_quantum, bits_20, 1e-6 * bits_20);
    EXPECT_FALSE(read_capture(path, {.torque_constant = 0.2}).torque_in_ampere);
    EXPECT_NEAR(read_capture(path, {.torque_constant = 0.2}).torque_ref[0], 0.2 * 9.9932, 1e-12);
}

TEST(RealData, AllEposFiles) {
    const std::string folder = data_folder() + "/epos_drive1";
    SKIP_WITHOUT(folder);
    size_t files = 0;
    for (const auto& file : fs::directory_iterator(folder)) {
        SCOPED_TRACE(file.path().filename().string());
        const Capture capture = read_capture(file.path().string());
        ++files;
        EXPECT_EQ(capture.rows(), 500u);
        EXPECT_TRUE(capture.uniform);
        EXPECT_FALSE(capture.has_position());
        EXPECT_EQ(capture.sample_time_s, std::stod(capture.metadata.at("sample_time_s")));
        const double rpm = 2 * std::numbers::pi / 60, permille_of_rated = 0.00984e-3;
        EXPECT_NEAR(capture.velocity_quantum, rpm, 1e-5 * rpm);
        EXPECT_NEAR(capture.torque_quantum, permille_of_rated, 1e-3 * permille_of_rated);
    }
    EXPECT_EQ(files, 34u);
}

TEST(RealData, OdriveCarriesItsOwnTimes) {
    const std::string path = data_folder() + "/odrive_slow/odrive_slow.csv";
    SKIP_WITHOUT(path);
    const Capture capture = read_capture(path);
    ASSERT_EQ(capture.rows(), 4306u);
    EXPECT_FALSE(capture.uniform);
    EXPECT_NEAR(capture.sample_time_s, 0.0023, 1e-4);
    EXPECT_NEAR(capture.position.back(), 2 * std::numbers::pi * 0.99564183, 1e-9);
    // Not whole counts of its 8192: the drive sent its estimate, printed with 8 decimals.
    EXPECT_NEAR(capture.position_quantum, 2 * std::numbers::pi * 1e-8, 1e-15);
}

} // namespace
