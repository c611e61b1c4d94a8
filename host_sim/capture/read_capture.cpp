#include "capture/assemble.hpp"
#include "capture/capture.hpp"
#include "capture/csv_reader.hpp"
#include "capture/mat_reader.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <filesystem>

namespace servoid {

CaptureScales scales_of(const Model& model) {
    return {model.drive.rated_torque, model.drive.torque_constant, model.sensor.position_per_count,
            model.motion == Motion::linear};
}

Capture read_capture(const std::string& path, const CaptureScales& scales, const SignalMap* map,
                     const Progress& progress) {
    const std::string ending = lower_case(std::filesystem::path(path).extension().string());
    if (ending == ".mat") return assemble(read_mat(path, map), scales);
    const std::string text = read_file(path); // a missing file is said before a wrong ending
    if (ending != ".csv")
        throw FileError(path, 0,
                        "the ending says nothing about the format; expected .csv, .mat or .log");
    return assemble(read_csv(text, path, map, progress), scales);
}

} // namespace servoid
