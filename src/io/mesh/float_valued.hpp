#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "condyle/pose.hpp"

namespace condyle::io {

/// Whether floats hold these numbers to the last bit. What a float cannot reach overflows: compare before
/// converting.
inline bool is_float_valued(std::span<const double> values) {
  constexpr double largest = std::numeric_limits<float>::max();
  return std::all_of(values.begin(), values.end(), [](double value) {
    return std::abs(value) <= largest && static_cast<double>(static_cast<float>(value)) == value;
  });
}

inline bool is_float_valued(const Points& points) {
  return is_float_valued(points.x) && is_float_valued(points.y) && is_float_valued(points.z);
}

}  // namespace condyle::io
