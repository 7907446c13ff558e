#pragma once

#include <cmath>
#include <limits>

/// Bounds of doubles in single precision.

namespace condyle::core {
namespace float_bounds {

/// More than a rounding to single precision, relative, and more than one among the smallest numbers.
inline constexpr double slack = 0x1p-23, least = std::numeric_limits<float>::min();

}  // namespace float_bounds

/// No less than a double.
inline float float_above(double value) noexcept {
  return static_cast<float>(value + std::abs(value) * float_bounds::slack + float_bounds::least);
}

/// No more than a double.
inline float float_below(double value) noexcept {
  return static_cast<float>(value - std::abs(value) * float_bounds::slack - float_bounds::least);
}

}  // namespace condyle::core
