// What the page shows, as one JSON object: the report holds it, the studio sends it.
//
// Everything is computed here and drawn there: the page knows no physics and computes no
// statistics.
//
//   schema      "servoid.story/1"
//   title       the model's name
//   unit        {"torque", "position", "velocity", "acceleration"}: "N·m", "rad", ...
//   verdict     of the diagnosis, or of the refinement of a model that lacks something
//   sentence    the verdict for people
//   advice      what to do next, a few sentences
//   basis       "fitted": every number of the model was fitted again before anything is shown; or
//               "as given"
//   given_error torque error of the model as given
//   compare     servoid.compare/1 of the model on that basis
//   diagnose    servoid.diagnose/1, or null where it was not asked for
//   refine      servoid.refine/1, or null
//   model_toml, refined_toml   model files; the second, and all that is refined below, null
//               without a refinement, and where it is the refined model that is shown
//   captures    per capture: file, sha256, rows, duration_s, sample_time_s, columns (names),
//               band_Hz, series, worst
//     series      "recorded_torque", "torque", "model_torque", "residual",
//                 "refined_torque", "refined_residual", "position",
//                 "loop_position": each a Series or null. torque, model_torque, residual and the
//                 refined ones are through the band limit; position and velocity on the same
//                 instants; loop_position: of the model in its own loop
//       Series    {"start_s", "step_s", "count", "bucket", "offset", "scale", "low", "high"}:
//                 value k = offset + scale·int16 k at start_s + k·step_s; base64 of little-endian
//                 int16, −32768: no value. bucket 1: "low" holds the values, "high" is null; else
//                 each value k stands for `bucket` instants, their least in "low", most in "high"
//     worst       [{"from_s", "to_s", "residual_share", "sample_share", "what"}], worst first:
//                 stretches of time that hold much of the residual
//   against     [{"variable", "unit", "bins": [{"from", "to", "mean", "std", "residual_share",
//               "sample_share"}], "x": [..], "y": [..]}]: residual against velocity, position,
//               acceleration, torque; x, y: a few thousand of the points
//   spectrum    {"frequency_Hz", "torque", "residual", "floor"}: amplitudes of a line, torque unit
//   orders      {"unit": "per rev" or "per m", "order", "residual"} or null: amplitude of the
//               residual's wave over the position
//   response    {"frequency_Hz", "measured_gain", "measured_phase_deg", "model_gain",
//               "model_phase_deg", "bias_percent", "bias_std_percent", "coherence"} or null: from
//               torque to acceleration; bias: of the measured gain against the model's
//   candidates  [{"effect", "against", "against_unit", "value", "value_unit", "x", "residual",
//               "effect_torque"}] in the order of diagnose.candidates, the first of those that were
//               fitted: the mean of what the model leaves, and of what this effect would take of
//               it, over bins of what shows it best
//   parameters  {"before": P, "after": P or null}, P: {"name", "unit", "value", "std", "believed",
//               "fixed", "at_bound", "lower", "upper", "correlation"}: columns of a table, the last
//               one a matrix or null; null where there is no such number
//   provenance  {"program", "version", "date", "commands": [..],
//               "files": [{"file", "sha256", "bytes"}]}
//
// Arrays of numbers hold null for what is not a number.
#pragma once

#include "answers/json.hpp"
#include "diagnose/diagnose.hpp"
#include "story/provenance.hpp"

namespace servoid {

struct StoryInput {
    const Model& given;
    const std::vector<PreparedMotion>& motions;
    // The model that is shown; its fit, where its numbers were fitted.
    const Model& shown;
    const FitResult* fit = nullptr;
    const Diagnosis* diagnosis = nullptr;   // of `given`
    const Refinement* refinement = nullptr; // of `given`
    std::vector<std::string> warnings;
    Provenance provenance;
};

// Cost: that of a few evaluations of the model, and about 4 MB of text for a long capture.
Json make_story(const StoryInput& input);

} // namespace servoid
