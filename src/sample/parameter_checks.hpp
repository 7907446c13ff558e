#pragma once

#include <cstddef>

#include "condyle/angle.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle::sample {

/// Each raises UsageError that names what is out of its range, and the range.

void require_range(const char* name, double value, double low, double high, const char* unit);
/// Angles compare as they are: in degrees, ends of the range would come back rounded.
void require_range(const char* name, Angle value, Angle low, Angle high);

/// Triangles of a closed mesh: an even number, `low` to 4 million.
void require_count(const char* mesh, std::size_t triangles, std::size_t low);

/// Every parameter within the range stated with it.
void require_valid(const HipParameters& hip);

}  // namespace condyle::sample
