// Commands to repeat something, ready to be pasted into a shell.
#pragma once

#include "cli/app.hpp"

namespace servoid::cli {

// As it is where a shell takes it as one word; else in single quotes.
std::string shell_word(const std::string& text);
// " --map FILE --band HZ --input ref", as far as they were said.
std::string options_of(const CaptureOptions& captures);

// The `servoid add` that adds a law, under a name that the model does not have yet.
std::string add_command(const std::string& law, const Model& model, const std::string& model_path,
                        const CaptureOptions& captures);

} // namespace servoid::cli
