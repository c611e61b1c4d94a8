// Variables of a MATLAB level 5 file as columns.
#pragma once

#include "capture/capture.hpp"
#include "capture/raw_table.hpp"

namespace servoid {

// Throws FileError where the file, a variable or the map (nullptr: none given) is wrong.
RawTable read_mat(const std::string& path, const SignalMap* map);

} // namespace servoid
