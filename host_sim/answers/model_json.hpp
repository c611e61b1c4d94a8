// A model as JSON: the tables of the model file.
#pragma once

#include "answers/json.hpp"
#include "model/model.hpp"

namespace servoid {

Json model_json(const Model& model);

} // namespace servoid
