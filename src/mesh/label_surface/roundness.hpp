#pragma once

#include "condyle/points.hpp"

namespace condyle::mesh {

/// Share of an equilateral triangle's area that a triangle of the same squared sides has, up to a factor: 0.29 is the roundest.
inline double roundness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  return ab.cross(ca).norm() / (ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm());
}

}  // namespace condyle::mesh
