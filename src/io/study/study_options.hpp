#pragma once

#include <string>

#include "condyle/io/study.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

/// The query options as JSON: the same text for the same options, whatever the order they were given in.
std::string options_json(const StudyOptions& options);

/// Requested quantities of one load.
Json load_json(const StudyLoad& load, Anatomy joint);

}  // namespace condyle::io
