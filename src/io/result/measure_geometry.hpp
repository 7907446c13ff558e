#pragma once

#include "condyle/hip_measures.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

/// Planes, axes and points that measures were made with, by the names of MeasureDefinition::measured_by but for the list `rim`; null where
/// they were not found. The femur's are in the mobile body's frame, the rest in the fixed one's.
Json measure_geometry(const measure::HipMeasures& measures);

}  // namespace condyle::io
