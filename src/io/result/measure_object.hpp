#pragma once

#include "io/result/json.hpp"
#include "io/result/measure_result.hpp"

namespace condyle::io {

/// measure_json() before it is text.
Json measure_object(const MeasureResult& result);

}  // namespace condyle::io
