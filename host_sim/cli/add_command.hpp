// The `servoid add` that adds a law, ready to be pasted into a shell.
#pragma once

#include "cli/app.hpp"

namespace servoid::cli {

// Under a name that the model does not have yet.
std::string add_command(const std::string& law, const Model& model, const std::string& model_path,
                        const CaptureOptions& captures);

} // namespace servoid::cli
