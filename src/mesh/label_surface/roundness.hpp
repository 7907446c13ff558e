#pragma once

#include "condyle/pose.hpp"
#include "core/ordered_sums.hpp"

namespace condyle::mesh {

/// Share of an equilateral triangle's area that a triangle of the same squared sides has, up to a factor: 0.29 is the roundest.
inline double roundness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  return core::ordered_norm(ab.cross(ca)) /
         (core::ordered_dot(ab, ab) + core::ordered_dot(bc, bc) + core::ordered_dot(ca, ca));
}

}  // namespace condyle::mesh
