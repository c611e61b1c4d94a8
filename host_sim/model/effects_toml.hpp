// The [effects] part of a model file.
#pragma once

#include "common/toml_view.hpp"
#include "model/model.hpp"

namespace servoid {

// Reads every table below [effects] into model.effects, in the order of the file. The model's
// motion must be known already. Throws FileError.
void read_effects(const TomlView& effects, Model& model);

// Keys of a `fixed = [...]` list, each of which must be one of `parameters`.
std::vector<std::string> read_fixed(const TomlView& table,
                                    const std::vector<std::string>& parameters);

} // namespace servoid
