// `refine` as a terminal sees it: the ladder grows while it is climbed.
#pragma once

#include "cli/diagnose_output.hpp"
#include "cli/ladder.hpp"
#include "cli/progress.hpp"
#include "compare/over_time.hpp"

#include <optional>

namespace servoid::cli {

class LiveRefinement {
  public:
    LiveRefinement(const Output& output, const std::vector<PreparedMotion>& motions);

    // Of the refinement that is shown. This object must outlive it.
    DiagnoseOptions options();
    // What the ladder has led to; nothing where stdout is no terminal.
    void show_end(const Refinement& r, const NextCommands& next, bool ampere);

  private:
    void show_rung(const Refinement& r);
    std::vector<TimePart> parts_of(const FitResult& fit) const;

    const Output& out_;
    const std::vector<PreparedMotion>& motions_;
    ProgressLine line_;
    std::optional<Ladder> ladder_; // from the first rung on
    std::vector<TimePart> before_;
};

} // namespace servoid::cli
