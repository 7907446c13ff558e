#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/io/model_file.hpp"

/// Results of `condyle inspect` for models of OpenSim. Keys of the JSON are listed in docs/models.md.

namespace condyle::io {

std::string models_text(std::span<const Model> models);
std::string models_json(std::span<const Model> models, const std::vector<std::string>& command);

}  // namespace condyle::io
