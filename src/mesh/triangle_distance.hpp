#pragma once

#include <array>

#include "condyle/pose.hpp"

/// Nearest points of triangles, in doubles.

namespace condyle::mesh {

struct NearestPoints {
  Vec3 a, b;
  double squared_distance;
};

/// The foot of p where it is inside the triangle, else the nearest point of an edge.
Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& triangle) noexcept;

/// Nearest points of the segments a b and c d. The nearest pair either lies inside both lines, where the connecting
/// line is at a right angle to both, or holds an end.
NearestPoints between_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

/// Nearest points of two triangles that do not intersect.
NearestPoints between_triangles(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) noexcept;

}  // namespace condyle::mesh
