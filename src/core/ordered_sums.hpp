#pragma once

#include <cmath>

#include "condyle/points.hpp"

/// Sums of products in one order, whatever the instruction set: Eigen's own order depends on whether it has vectors of two doubles, and
/// the core as WebAssembly has none.

namespace condyle::core {

inline double ordered_dot(const Vec3& a, const Vec3& b) noexcept {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

inline double ordered_norm(const Vec3& v) noexcept {
  return std::sqrt(ordered_dot(v, v));
}

/// Scaled to length 1, whatever its length; zero stays zero. Like Eigen's stableNormalized().
inline Vec3 ordered_direction(const Vec3& v) noexcept {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return v;
  return v / (ordered_norm(v / largest) * largest);
}

}  // namespace condyle::core
