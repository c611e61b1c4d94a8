// An experiment on a drive, wherever its axis stands.
#pragma once

#include "node/master.hpp"

namespace servoid {

using Note = std::function<void(const std::string&)>;

// Where the experiment begins elsewhere (Experiment::start), goes there first, no faster than the
// experiment itself, and forgets what was recorded on the way; then makes the move and lets the
// axis come to rest.
RunEnd go_and_move(Master& master, Link& link, const Experiment& experiment,
                   const OnProgress& progress, const Note& note);

} // namespace servoid
