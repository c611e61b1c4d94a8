// Finds where the position zeros of the captures lie, from how they shift the waves of the
// position that the model has.
//
// An offset is adopted only where the captures demand it: it is one of many places that were looked
// at, and most encoders are homed. Then the gain in log-likelihood, N·ln(e₀/e₁) with N independent
// residuals, must exceed ln(places) + 3; else the offset stays exactly 0.
#pragma once

#include "compare/regression.hpp"

#include <optional>

namespace servoid {

// The offsets of all captures after the first that recorded its position, with the model's shapes
// as they are and its coefficients solved for. Those that the assembler holds stay, refined, where
// others are not clearly better. Free of cost for one capture or a model without waves of the
// position; else a few passes over the rows and 2 µs a place.
Homing find_homing(const Model& model, Assembler& assembler);
// Leaves them in the assembler, which sees the model as it is.
void home(const Model& model, Assembler& assembler);

// fit() after home(), and again where the fitted model finds other zeros.
FitResult fit_homed(const Model& model, Assembler& assembler, const FitOptions& options = {});
// The second half of it: a fit that was made with other shapes than it ended with.
FitResult home_again(FitResult fitted, Assembler& assembler, const FitOptions& options);

// One capture against a model whose parameters are all held.
struct ZeroOffset {
    Estimate offset;                    // rad or m
    double error_before = 0, error = 0; // ‖T − T̂‖/‖T‖ without and with it
};
// Nothing where the capture demands no offset.
std::optional<ZeroOffset> offset_against(const Model& model, const PreparedMotion& motion);
// The offsets of captures from `first` on, each against the model.
Homing homing_against(const Model& model, const std::vector<PreparedMotion>& motions, size_t first);

} // namespace servoid
