// Which physical effect is missing? Every effect of the catalogue that is not in the model is
// fitted together with all parameters of the model, and judged on data it was not fitted to.
#pragma once

#include "compare/compare.hpp"
#include "diagnose/candidates.hpp"
#include "diagnose/next_experiment.hpp"
#include "diagnose/probe.hpp"
#include "diagnose/unseen.hpp"

#include <functional>
#include <string>
#include <vector>

namespace servoid {

enum class Verdict {
    missing,     // the first candidate is justified by data it was not fitted to
    ambiguous,   // two or more explain it equally; advice names what separates them
    unknown,     // a repeatable residual that nothing in the catalogue explains
    adequate,    // the residual is noise
    insufficient // the capture cannot answer
};
const char* verdict_name(Verdict verdict);

// A richer form of another effect: not a rival of it, but the same with more freedom.
bool is_richer_form(const std::string& rich, const std::string& simple);

// Viscous and Coulomb friction, a constant torque: what every axis has.
bool is_everyday(const std::string& effect);

// The model with all of them that it lacks, where it lacks two or more.
struct Everyday {
    FitResult fit;
    double error = 0; // held out
};

struct Diagnosis {
    Verdict verdict = Verdict::insufficient;
    FitResult before; // the model as it is, every parameter fitted again
    double error_before = 0, validation_error_before = 0;
    std::vector<double> blocks_before; // held_out_blocks of `before`
    double noise_floor = 0;
    bool floor_from_repetition = false;
    std::optional<Everyday> everyday;
    std::vector<Candidate> candidates; // best first, every effect that was tried
    std::vector<Probe> probes;         // what the residual depends on, catalogue or not
    std::string not_noise; // why a residual that depends on nothing is no noise: "comes in bursts"
    std::string
        outside; // a law of no catalogue that explains as much as the first candidate, or ""
    std::optional<NextExperiment> next; // what tells the rivals of an ambiguous verdict apart
    std::vector<Unseen> cannot_show;    // what this capture neither shows nor excludes
    std::optional<Unseen> shortage;     // of an insufficient verdict
    std::string advice;
    double band_Hz = 0;
};

// Share of the residual's held-out power that a candidate takes away.
double gain_of(const Diagnosis& diagnosis, const Candidate& candidate);

struct Refinement;

struct DiagnoseOptions {
    Progress progress;      // of one pass over the catalogue; refine makes several
    bool look_ahead = true; // whether what would be left after the best candidate has a name too
    // Refine tells each rung when it is reached: the ladder, the result and the noise floor as
    // they are then. May be empty.
    std::function<void(const Refinement&)> on_rung = {};
};

Diagnosis diagnose(const Model& model, const std::vector<PreparedMotion>& motions,
                   const DiagnoseOptions& options = {});

struct Rung {
    std::string added; // empty: the model as it was
    double torque_error = 0, validation_error = 0;
};

struct Refinement {
    Verdict verdict = Verdict::insufficient; // of the last rung
    std::vector<Rung> ladder;
    std::vector<std::string> removed; // effects that a later one made needless
    FitResult result;
    Homing validation_homing; // of the validation captures, against the result
    Diagnosis last;
    double noise_floor = 0;
};

// Adds the most probable effect until nothing more is justified. `validation` is never fitted.
Refinement refine(const Model& model, const std::vector<PreparedMotion>& motions,
                  const std::vector<PreparedMotion>& validation,
                  const DiagnoseOptions& options = {});

} // namespace servoid
