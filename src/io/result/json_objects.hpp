#pragma once

#include "io/result/json.hpp"
#include "io/result/measure_result.hpp"
#include "io/result/resection_result.hpp"

/// Answers before they are text.

namespace condyle::io {

/// What measure_json() writes.
Json measure_object(const MeasureResult& result);

/// What resection_json() writes.
Json resection_object(const ResectionResult& result);

}  // namespace condyle::io
