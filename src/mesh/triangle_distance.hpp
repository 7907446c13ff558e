#pragma once

#include <array>

#include "condyle/points.hpp"

/// Nearest points of triangles, in doubles.

namespace condyle::mesh {

struct NearestPoints {
  Vec3 a, b;
  double squared_distance;
};

/// The foot of p where it is inside the triangle, else the nearest point of an edge.
Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& triangle) noexcept;

/// Of two triangles that do not intersect.
NearestPoints between_triangles(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) noexcept;

}  // namespace condyle::mesh
