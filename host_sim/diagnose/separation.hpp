// How far rivals are apart on a move: what each leaves of the record that another predicts.
#pragma once

#include "common/error.hpp"
#include "diagnose/rival_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace servoid {

struct Rivalry {
    Rivalry(std::vector<Model> models, const std::vector<PreparedMotion>& motions, double noise_rms,
            const MoveLimits& within);

    std::vector<Model> rivals; // best first
    Model base;                // what they have in common: a diagnosis begins with its fit
    MoveLimits limits;
    double noise = 0;    // rms in the band, N·m or N
    double band_Hz = 0;  // in which the noise was seen
    bool ampere = false; // torques are known as currents: no loop can be simulated

    // The effects that the others do not all have: "coulomb"; "no further effect" where none.
    std::string name_of(size_t rival) const;
    // Whether fitting one to the record of the other can leave anything: a model with one effect
    // more takes up whatever the simple one predicts.
    bool tells(size_t truth, size_t fitted) const;
    // Whether the model has more effects of this name than some rival.
    bool has_more(const Model& model, const std::string& effect) const;
};

struct Separation {
    double value = 0;             // smallest over all pairs and directions, in units of the noise
    size_t truth = 0, fitted = 0; // of the smallest
    double noise = 0, band_Hz = 0;
    std::string where; // regime that holds most of it
    size_t fits = 0;   // that it took
};

// An upper bound: the best rival's record fitted by each of the others from their own values, and
// the reverse where there are but two; no more is computed once it is below `least`. first: the
// best rival's record. Throws Refusal where the move shows nothing.
double screen(const Rivalry& rivalry, const std::string& experiment, Capture first, double least);

// Every pair, both ways; in pairs with the best rival the effect is searched for anew too, where
// that is better than its own values. No more is computed once it is below `least`. Throws Refusal
// where one of the rivals would leave the limits, or the move shows nothing of it.
Separation separation(const Rivalry& rivalry, const std::string& experiment, double least);

} // namespace servoid
