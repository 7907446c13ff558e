#pragma once

#include "io/result/json.hpp"
#include "io/result/resection_result.hpp"

namespace condyle::io {

/// resection_json() before it is text.
Json resection_object(const ResectionResult& result);

}  // namespace condyle::io
