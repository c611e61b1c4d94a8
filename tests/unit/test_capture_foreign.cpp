// Foreign files through a map: CSV with other names, and MATLAB files of every numeric class.
#include "capture/capture.hpp"
#include "capture_helpers.hpp"
#include "common/file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <matio.h>
#include <unistd.h>

using namespace servoid;

namespace {

SignalMap example_map() {
    SignalMap map;
    map.path = "map.toml";
    map.signals["time"] = {"t"};
    map.signals["force_ref"] = {"vir", 35.0};
    map.signals["position"] = {"qm", 1e-3, 0.5};
    map.metadata["period_s"] = "6.24";
    map.metadata["torque_hold"] = "none";
    return map;
}

class ForeignFile : public testing::Test {
  protected:
    ForeignFile()
        : path_(std::filesystem::temp_directory_path() /
                ("servoid_" + std::to_string(::getpid()) + ".mat")) {}
    ~ForeignFile() override {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    std::string path() const { return path_.string(); }

    template <class T>
    static void add(mat_t* file, const char* name, matio_classes klass, matio_types type,
                    std::vector<T>& values, bool row) {
        size_t dims[2] = {row ? 1 : values.size(), row ? values.size() : 1};
        matvar_t* variable = Mat_VarCreate(name, klass, type, 2, dims, values.data(), 0);
        Mat_VarWrite(file, variable, MAT_COMPRESSION_ZLIB);
        Mat_VarFree(variable);
    }

    std::filesystem::path path_;
};

TEST_F(ForeignFile, CsvWithOtherNamesAndUnusedColumns) {
    std::string text = "t,remark,vir,qm,spare\n";
    for (int i = 0; i < 20; ++i)
        text += fmt::format("{:.3f},any text,{},{},\n", i * 0.001, i, 2 * i);
    const SignalMap map = example_map();
    const Capture capture = read_text(text, {}, &map);
    EXPECT_TRUE(capture.linear);
    EXPECT_FALSE(capture.ref_held);
    EXPECT_EQ(capture.period_s, 6.24);
    EXPECT_EQ(capture.torque_ref[3], 105);
    EXPECT_NEAR(capture.position[3], 0.506, 1e-15);
    EXPECT_TRUE(capture.torque.empty());
}

TEST_F(ForeignFile, MatOfMixedClassesRowsAndColumns) {
    mat_t* file = Mat_CreateVer(path().c_str(), nullptr, MAT_FT_MAT5);
    std::vector<double> time;
    std::vector<float> volts;
    std::vector<mat_int32_t> counts;
    for (int i = 0; i < 50; ++i) {
        time.push_back(i * 0.002);
        volts.push_back(0.25f * static_cast<float>(i % 7));
        counts.push_back(3 * i * i - 400);
    }
    add(file, "t", MAT_C_DOUBLE, MAT_T_DOUBLE, time, true);
    add(file, "vir", MAT_C_SINGLE, MAT_T_SINGLE, volts, false);
    add(file, "qm", MAT_C_INT32, MAT_T_INT32, counts, true);
    Mat_Close(file);
    const SignalMap map = example_map();
    const Capture capture = read_capture(path(), {}, &map);
    ASSERT_EQ(capture.rows(), 50u);
    EXPECT_NEAR(capture.sample_time_s, 0.002, 1e-15);
    for (size_t i = 0; i < 50; ++i) {
        EXPECT_EQ(capture.torque_ref[i], 35.0 * static_cast<double>(volts[i]));
        EXPECT_NEAR(capture.position[i], counts[i] * 1e-3 + 0.5, 1e-15);
    }
}

// Every truncation and many single damaged bytes of a real file: read, or refused with a reason.
TEST_F(ForeignFile, DamagedMatIsReadOrRefusedButNeverCrashes) {
    const std::string whole =
        read_file(std::string(SERVOID_SOURCE_DIR) + "/tests/cli/bad/mat_without_map.mat");
    const SignalMap map = example_map();
    const auto attempt = [&](const std::string& bytes) {
        std::ofstream(path(), std::ios::binary)
            << bytes; // write_file would flush to disk each time
        try {
            read_capture(path(), {}, &map);
            return true;
        } catch (const FileError&) {
            return false;
        }
    };
    EXPECT_TRUE(attempt(whole));
    for (size_t length = 0; length < whole.size(); ++length)
        EXPECT_FALSE(attempt(whole.substr(0, length))) << "cut at " << length;
    for (size_t at = 0; at < whole.size(); at += 3) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        EXPECT_NO_THROW(attempt(damaged)) << "damaged at " << at;
    }
}

} // namespace
