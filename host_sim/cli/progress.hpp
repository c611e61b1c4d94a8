// Progress of long work, one line on a terminal's stderr.
#pragma once

#include "cli/app.hpp"
#include "common/progress.hpp"

#include <memory>

namespace servoid::cli {

// The line: what is done, how far it is and how long it will take. Shown from the moment on at
// which it is worth it, no wider than the terminal, gone when the object is (an error ends it, too)
// or somebody clears it. Nothing where stderr is no terminal, or one that cannot write over a line,
// and nothing under --quiet or --json.
class ProgressLine {
  public:
    explicit ProgressLine(const Output& output);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    // To be handed to whoever works; empty where nothing is shown. It must not outlive the line.
    Progress progress() const;
    // Work of which nobody can tell how far it is.
    void phase(const std::string& what) const;
    // What is printed next stands in a clean line.
    void clear() const;

  private:
    struct Pass;
    std::unique_ptr<Pass> pass_; // none: nothing is shown
};

// The same, with a few words in front of what is done.
Progress named(const std::string& words, const Progress& progress);

} // namespace servoid::cli
