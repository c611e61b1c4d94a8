// The error ladder: a bar per rung, down to the noise floor.
#pragma once

#include "cli/app.hpp"
#include "diagnose/diagnose.hpp"

#include <string>

namespace servoid::cli {

// Bars are logarithmic: between a first model and the noise there is often a factor of a hundred,
// and every factor gained is as long as any other. The noise floor is a line through all of them.
class Ladder {
  public:
    Ladder(const Output& out, double top, double noise_floor);

    void print_head() const;
    void print(const Rung& rung); // the next one
    size_t rungs() const { return rungs_; }

  private:
    struct Columns {
        int name, error, unseen, factor, bar; // 0: there is no room for it
    };
    Columns columns() const;
    double share_of(double error) const;
    std::string bar_of(double error, int columns) const;

    const Output& out_;
    double floor_, low_, span_; // of the logarithm: where bars begin, and how far it is to the top
    double last_error_ = 0;
    size_t rungs_ = 0;
};

} // namespace servoid::cli
