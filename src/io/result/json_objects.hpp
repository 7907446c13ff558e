#pragma once

#include "io/result/json.hpp"
#include "io/result/measure_result.hpp"
#include "io/result/resection_result.hpp"

/// Answers before they are text.

namespace condyle::io {

/// Of measure_json().
Json measure_object(const MeasureResult& result);

/// Of resection_json().
Json resection_object(const ResectionResult& result);

}  // namespace condyle::io
