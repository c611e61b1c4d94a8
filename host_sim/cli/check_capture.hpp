// What is wrong with a capture, told before anything is fitted to it; and answers that are none.
#pragma once

#include "cli/app.hpp"
#include "diagnose/diagnose.hpp"

#include <functional>

namespace servoid::cli {

// Throws Refusal where the capture cannot be what it says; else its warnings, also on stderr.
std::vector<std::string>
check_capture(const Model& model, const std::vector<PreparedMotion>& motions, const Output& output);

// The phases that the model states belong to another recording than this one: said, not repaired.
void warn_of_zero(const Model& model, const PreparedMotion& motion,
                  std::vector<std::string>& warnings, const Output& output);

// "this capture cannot show: …", a line per reason.
void print_cannot_show(const Output& output, const std::vector<Unseen>& unseen);

// Does the work; where it refuses, prints the answer `insufficient` with the reason and what to
// record instead, every other key as in `empty`, and refuses all the same (exit code 4).
void or_insufficient(const Output& output, Json empty, const std::function<void()>& work);

// After the answer was printed: exit code 4 where it is `insufficient`.
void refuse_if_insufficient(const Diagnosis& diagnosis);

} // namespace servoid::cli
