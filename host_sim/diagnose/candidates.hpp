// Every effect of the catalogue that may stand in a model, fitted together with all of it.
#pragma once

#include "common/progress.hpp"
#include "compare/regression.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace servoid {

struct Candidate {
    std::string effect;
    double probability = 0;
    double error_after = NAN;                // on the data it was fitted to
    double validation_error_after = NAN;     // on blocks it was not fitted to
    double foreseen_error_after = NAN;       // the same, against what could be foreseen of each
    std::vector<FittedParameter> parameters; // of the effect itself
    std::string signature;
    std::string note; // why it was not fitted, a parameter on its bound, an alias
    FitResult fit;    // empty model name where it was not fitted
    bool fitted = false;
    std::vector<double> blocks_after; // held_out_blocks of the fit
    double noise_gain = NAN; // fall of ln(error) that noise alone would cause; NaN: not asked
    bool sound = false;      // fitted, every parameter determined and off its bounds
};

// Which effects are tried: those that are only solved for cost a tenth of those that are searched.
enum class Tried { all, solved, searched };

// In the order of the catalogue. By two threads.
std::vector<Candidate> try_all(const FitResult& before, const std::vector<PreparedMotion>& motions,
                               const Progress& progress, Tried tried = Tried::all);

// The best few again, without what the method itself leaves of each (twin.hpp).
void polish_best(std::vector<Candidate>& candidates, const FitResult& before,
                 const std::vector<PreparedMotion>& motions);

// One of them to the end: several rounds of that.
void finish(Candidate& candidate, const FitResult& before, Assembler& assembler);

} // namespace servoid
