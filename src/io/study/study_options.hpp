#pragma once

#include <string>

#include "condyle/io/study.hpp"

namespace condyle::io {

/// The query options as JSON: the same text for the same options, whatever the order they were given in.
std::string options_json(const StudyOptions& options);

}  // namespace condyle::io
