// Whole files in, whole files out.
#pragma once

#include <string>

namespace servoid {

// The whole file. Throws FileError where it cannot be read (missing, a folder, over 2 GiB).
std::string read_file(const std::string& path);

// Writes beside the target, flushes to disk and renames: the file is there whole or not at all.
// "-" writes to stdout. Throws FileError.
void write_file(const std::string& path, const std::string& content);

} // namespace servoid
