// Progress of long work, one line on a terminal's stderr.
#pragma once

#include "cli/app.hpp"
#include "diagnose/diagnose.hpp"

namespace servoid::cli {

// Options of diagnose and refine that show what is tried, how far it is and how long it will take;
// nothing where stderr is no terminal or under --quiet. The line is gone when the work is done.
DiagnoseOptions with_progress(const Output& output);

} // namespace servoid::cli
