// Where the measured data lie, and EMPS as every test reads it.
#pragma once

#include "capture/capture.hpp"
#include "model/model.hpp"
#include "paper/figure.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace servoid::measured {

inline std::string data_folder() {
    const char* stated = std::getenv("SERVOID_DATA_DIR");
    return stated ? stated : std::string(SERVOID_SOURCE_DIR) + "/../shared/data";
}

inline std::string emps_csv() { return data_folder() + "/emps/emps_train.csv"; }

inline Model emps_model() {
    return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/emps.toml");
}

#define SERVOID_SKIP_WITHOUT(path)                                                                 \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no data"

} // namespace servoid::measured
