// Whether a MATLAB level 5 file is whole, before a library reads it that trusts its sizes.
#pragma once

#include <string>

namespace servoid {

// Throws FileError. Looks at the header, at the size of every variable, and for variables that are
// not compressed at whether their numbers are as many as their dimensions say.
void check_mat_file(const std::string& path, const std::string& bytes);

} // namespace servoid
